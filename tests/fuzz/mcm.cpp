// Fuzzes the reader of saved cut-meshes (libFuzzer): any bytes, with the checksums corrected, give a cut-mesh whose arrays are sound and
// that is the same to the bit when saved and loaded again, or a FileError that names the file.
#include <cstdint>
#include <cstdlib>

#include "mandoline/validate.h"
#include "mcm_file.h"
#include "same_bits.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  repairChecksums(bytes);
  try {
    const mandoline::CutMesh cutMesh = readMcm(bytes);
    if (!checkArrays(cutMesh).pass || !differences(cutMesh, readMcm(mcmOf(cutMesh))).empty()) std::abort();
  } catch (const mandoline::FileError& error) {
    if (std::string(error.what()).find("a.mcm: ") != 0) std::abort();
  }
  return 0;
}
