#include "io/mcm/integers.h"

#include <algorithm>
#include <array>
#include <bit>

namespace mandoline::detail {
namespace {

constexpr uint64_t kDirect = 16;  // integers below are symbols of their own
constexpr int kDirectBits = 5;    // length of the first that is not
constexpr size_t kSymbols = kDirect + 2 * (64 - kDirectBits + 1);
constexpr int kScaleBits = 12;
constexpr uint32_t kScale = 1u << kScaleBits;      // sum of the frequencies
constexpr uint64_t kLowState = uint64_t(1) << 31;  // states are at least this, and below 2^32 times it
constexpr const char* kBadBlock = "has a block that can't be unpacked";

struct Split {
  uint8_t symbol;
  uint8_t bits;  ///< how many of the lowest the symbol does not tell
};

Split split(uint64_t n) {
  if (n < kDirect) return {uint8_t(n), 0};
  const int length = int(std::bit_width(n));
  return {uint8_t(kDirect + 2 * uint64_t(length - kDirectBits) + (n >> (length - 2) & 1)), uint8_t(length - 2)};
}

Split splitOf(size_t symbol) { return {uint8_t(symbol), uint8_t(symbol < kDirect ? 0 : (symbol - kDirect) / 2 + kDirectBits - 2)}; }

/// The integer without its lowest bits.
uint64_t base(size_t symbol) { return symbol < kDirect ? symbol : (2 | (symbol - kDirect) % 2) << splitOf(symbol).bits; }

using Frequencies = std::array<uint32_t, kSymbols>;

/// Scaled to the sum kScale, with none of the present ones at 0.
Frequencies frequencies(const std::vector<Split>& splits) {
  Frequencies counts{}, scaled{};
  for (const Split& s : splits) ++counts[s.symbol];
  uint32_t sum = 0;
  for (size_t s = 0; s < kSymbols; ++s) {
    if (counts[s] > 0) scaled[s] = std::max(1u, uint32_t(uint64_t(counts[s]) * kScale / splits.size()));
    sum += scaled[s];
  }
  while (sum != kScale) {  // rounding is at the cost of the largest, or to its gain
    uint32_t& largest = *std::max_element(scaled.begin(), scaled.end());
    const uint32_t changed = sum < kScale ? largest + (kScale - sum) : largest - std::min(sum - kScale, largest / 2);
    sum += changed - largest;
    largest = changed;
  }
  return scaled;
}

Frequencies starts(const Frequencies& frequency) {
  Frequencies start{};
  for (size_t s = 1; s < kSymbols; ++s) start[s] = start[s - 1] + frequency[s - 1];
  return start;
}

uint64_t wordAt(const char* bytes, size_t count) {
  uint64_t word = 0;
  for (size_t i = 0; i < count; ++i) word |= uint64_t(uint8_t(bytes[i])) << 8 * i;
  return word;
}

/// The words come in the order in which they are read: last written first.
std::string packSymbols(const std::vector<Split>& splits, const Frequencies& frequency) {
  const Frequencies start = starts(frequency);
  std::vector<uint32_t> words;
  uint64_t state = kLowState;
  for (size_t i = splits.size(); i-- > 0;) {
    const size_t s = splits[i].symbol;
    if (frequency[s] == kScale) break;  // the only symbol leaves the state as it is
    if (state >= (kLowState >> kScaleBits << 32) * frequency[s]) {
      words.push_back(uint32_t(state));
      state >>= 32;
    }
    state = (state / frequency[s] << kScaleBits) + state % frequency[s] + start[s];
  }
  std::string out;
  putWord(out, state, 8);
  for (size_t i = words.size(); i-- > 0;) putWord(out, words[i], 4);
  return out;
}

class BitWriter {
 public:
  void put(uint64_t value, int bits) {
    for (; bits > 0; bits -= 32, value >>= 32) {
      const int part = std::min(bits, 32);
      word_ |= (value & ((uint64_t(1) << part) - 1)) << used_;
      used_ += part;
      if (used_ < 32) continue;
      putWord(bytes_, word_, 4);
      word_ >>= 32;
      used_ -= 32;
    }
  }
  const std::string& finish() {
    putWord(bytes_, word_, (used_ + 7) / 8);
    return bytes_;
  }

 private:
  std::string bytes_;
  uint64_t word_ = 0;
  int used_ = 0;
};

class BitReader {
 public:
  explicit BitReader(std::string_view bytes) : bytes_(bytes) {}

  uint64_t take(int bits) {
    if (bits <= 32) return takePart(bits);
    const uint64_t low = takePart(32);
    return low | takePart(bits - 32) << 32;
  }
  void finish() const {
    if (next_ != bytes_.size() || word_ != 0) throw Damaged{kBadBlock};
  }

 private:
  uint64_t takePart(int bits) {
    if (known_ < bits) {
      const size_t count = std::min<size_t>(4, bytes_.size() - next_);
      word_ |= wordAt(bytes_.data() + next_, count) << known_;
      next_ += count;
      known_ += 8 * int(count);
      if (known_ < bits) throw Damaged{kBadBlock};
    }
    const uint64_t value = word_ & ((uint64_t(1) << bits) - 1);
    word_ >>= bits;
    known_ -= bits;
    return value;
  }

  std::string_view bytes_;
  uint64_t word_ = 0;
  size_t next_ = 0;
  int known_ = 0;
};

/// What the lowest bits of a state tell.
struct Slots {
  struct Symbol {
    uint64_t base;
    uint32_t frequency, start;
    int bits;
  };
  std::array<Symbol, kSymbols> symbols;
  std::array<uint8_t, kScale> symbolAt;

  explicit Slots(const Frequencies& frequency) {
    uint32_t start = 0;
    for (size_t s = 0; s < kSymbols; ++s) {
      symbols[s] = {base(s), frequency[s], start, splitOf(s).bits};
      std::fill_n(symbolAt.begin() + start, frequency[s], uint8_t(s));
      start += frequency[s];
    }
  }
};

Frequencies takeFrequencies(std::string_view& bytes) {
  Frequencies frequency{};
  const uint64_t count = takeLength(bytes);
  if (count > kSymbols) throw Damaged{kBadBlock};
  uint64_t sum = 0;
  for (size_t s = 0; s < count; ++s) {
    const uint64_t f = takeLength(bytes);
    sum += f;
    if (f > kScale) throw Damaged{kBadBlock};
    frequency[s] = uint32_t(f);
  }
  if (sum != kScale) throw Damaged{kBadBlock};
  return frequency;
}

void unpack(const Slots& slots, std::string_view symbols, BitReader& bits, std::vector<uint64_t>& block) {
  if (symbols.size() < 8 || symbols.size() % 4 != 0) throw Damaged{kBadBlock};
  uint64_t state = wordAt(symbols.data(), 8);
  size_t at = 8;
  const auto symbolNow = [&]() -> const Slots::Symbol& { return slots.symbols[slots.symbolAt[state & (kScale - 1)]]; };
  if (symbolNow().frequency == kScale && symbolNow().bits == 0) {  // the only one leaves the state as it is
    std::fill(block.begin(), block.end(), symbolNow().base);
  } else {
    for (uint64_t& n : block) {
      const Slots::Symbol& symbol = symbolNow();
      n = symbol.bits == 0 ? symbol.base : symbol.base | bits.take(symbol.bits);
      state = symbol.frequency * (state >> kScaleBits) + (state & (kScale - 1)) - symbol.start;
      if (state >= kLowState) continue;
      if (at == symbols.size()) throw Damaged{kBadBlock};
      state = state << 32 | wordAt(symbols.data() + at, 4);
      at += 4;
    }
  }
  if (state != kLowState || at != symbols.size()) throw Damaged{kBadBlock};
}

}  // namespace

void putWord(std::string& out, uint64_t word, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(char(word >> 8 * i));
}

void putLength(std::string& out, uint64_t n) {
  for (; n >= 128; n >>= 7) out.push_back(char(n | 128));
  out.push_back(char(n));
}

uint64_t takeLength(std::string_view& bytes) {
  uint64_t n = 0;
  for (int shift = 0; shift < 63; shift += 7) {
    if (bytes.empty()) break;
    const uint8_t byte = uint8_t(bytes.front());
    bytes.remove_prefix(1);
    n |= uint64_t(byte & 127) << shift;
    if (byte < 128) return n;
  }
  throw Damaged{"has a length that can't be read"};
}

std::string_view takeBytes(std::string_view& bytes, uint64_t count) {
  if (count > bytes.size()) throw Damaged{"has a part that goes beyond its end"};
  const std::string_view taken = bytes.substr(0, size_t(count));
  bytes.remove_prefix(size_t(count));
  return taken;
}

void IntegerWriter::writeBlock() {
  std::vector<Split> splits(block_.size());
  std::transform(block_.begin(), block_.end(), splits.begin(), split);
  const Frequencies frequency = frequencies(splits);
  size_t count = kSymbols;
  while (frequency[count - 1] == 0) --count;
  BitWriter bits;
  for (size_t i = 0; i < splits.size(); ++i) bits.put(block_[i], splits[i].bits);
  putLength(bytes_, block_.size());
  putLength(bytes_, count);
  for (size_t s = 0; s < count; ++s) putLength(bytes_, frequency[s]);
  for (const std::string& part : {packSymbols(splits, frequency), bits.finish()}) {
    putLength(bytes_, part.size());
    bytes_ += part;
  }
  block_.clear();
}

void IntegerWriter::finish(std::string& out) {
  if (!block_.empty()) writeBlock();
  putLength(out, bytes_.size());
  out += bytes_;
}

IntegerReader::IntegerReader(std::string_view& bytes) : bytes_(takeBytes(bytes, takeLength(bytes))) {}

void IntegerReader::readBlock() {
  const uint64_t count = takeLength(bytes_);
  if (count == 0 || count > IntegerWriter::kBlock) throw Damaged{kBadBlock};
  const Slots slots(takeFrequencies(bytes_));
  const std::string_view symbols = takeBytes(bytes_, takeLength(bytes_));
  BitReader bits(takeBytes(bytes_, takeLength(bytes_)));
  block_.resize(size_t(count));
  unpack(slots, symbols, bits, block_);
  bits.finish();
  next_ = 0;
}

void IntegerReader::expect(uint64_t count) const {
  constexpr uint64_t kSmallestBlock = 14;  // of one symbol: count, frequencies, 8 bytes of state and two lengths
  const uint64_t blocks = bytes_.size() / kSmallestBlock;
  if (count > block_.size() - next_ + blocks * IntegerWriter::kBlock) throw Damaged{"is said to be longer than its bytes can be"};
}

void IntegerReader::finish() const {
  if (next_ != block_.size() || !bytes_.empty()) throw Damaged{"has more entries than it is said to have"};
}

}  // namespace mandoline::detail
