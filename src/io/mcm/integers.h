// Integers in few bytes: small ones and common ones take less than a byte.
//
// They come in blocks. In a block each integer is a symbol, which tells the integer itself or its leading two bits and length, and the bits
// that are left. Symbols are entropy-coded by rANS (Duda 2013) with frequencies that the block tells; the bits follow as they are. A block
// of one symbol takes some 20 bytes, which limits how much a short file can claim to hold.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mandoline::detail {

/// Thrown for bytes that no writer made: `what` completes the name of an array to a sentence.
struct Damaged {
  const char* what;
};

inline uint64_t fromSigned(int64_t n) { return uint64_t(n) << 1 ^ uint64_t(n >> 63); }
inline int64_t toSigned(uint64_t n) { return int64_t(n >> 1) ^ -int64_t(n & 1); }

/// finish() has to be called at the end.
class IntegerWriter {
 public:
  void put(uint64_t n) {
    block_.push_back(n);
    if (block_.size() == kBlock) writeBlock();
  }
  void putSigned(int64_t n) { put(fromSigned(n)); }
  /// Appends all to the bytes, with their length before them.
  void finish(std::string& out);

  static constexpr size_t kBlock = size_t(1) << 14;

 private:
  void writeBlock();

  std::vector<uint64_t> block_;
  std::string bytes_;
};

/// Throws Damaged.
class IntegerReader {
 public:
  /// Takes what finish() has written from the front of the bytes.
  explicit IntegerReader(std::string_view& bytes);

  uint64_t next() {
    if (next_ == block_.size()) readBlock();
    return block_[next_++];
  }
  int64_t nextSigned() { return toSigned(next()); }
  /// Throws if so many more can't follow, before anyone reserves memory for them.
  void expect(uint64_t count) const;
  /// Throws if there are more.
  void finish() const;

 private:
  void readBlock();

  std::string_view bytes_;
  std::vector<uint64_t> block_;
  size_t next_ = 0;
  std::vector<char> symbols_, bits_;  // room for a block's
};

/// The lowest bytes of the word, the lowest first.
void putWord(std::string& out, uint64_t word, int bytes);
/// A length in one byte or a few: 7 bits in each, the highest bit tells that there are more.
void putLength(std::string& out, uint64_t n);
/// Takes it from the front of the bytes. Throws Damaged.
uint64_t takeLength(std::string_view& bytes);
/// Takes so many bytes from the front. Throws Damaged.
std::string_view takeBytes(std::string_view& bytes, uint64_t count);

}  // namespace mandoline::detail
