#include "io/mcm/integers.h"

#include <algorithm>
#include <array>
#include <bit>

#include "mesh/read/scalar.h"

namespace mandoline::detail {
namespace {

constexpr uint64_t kDirect = 16;  // integers below are symbols of their own
constexpr int kDirectBits = 5;    // length of the first that is not
constexpr size_t kSymbols = kDirect + 2 * (64 - kDirectBits + 1);
constexpr int kScaleBits = 12;
constexpr uint32_t kScale = 1u << kScaleBits;  // sum of the frequencies
constexpr uint32_t kLowState = 1u << 16;       // states are at least this, and below 2^16 times it
constexpr size_t kStates = 4;                  // symbol i is of state i % kStates: none has to wait for the one before it
constexpr size_t kStateBytes = 4, kWordBytes = 2;
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
  while (sum != kScale) {  // the largest makes up for the rounding
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

/// The words come in the order in which they are read: last written first.
std::string packSymbols(const std::vector<Split>& splits, const Frequencies& frequency) {
  const Frequencies start = starts(frequency);
  std::vector<uint16_t> words;
  std::array<uint32_t, kStates> states;
  states.fill(kLowState);
  for (size_t i = splits.size(); i-- > 0;) {
    const uint32_t f = frequency[splits[i].symbol];
    if (f == kScale) break;  // the only symbol leaves the states as they are
    uint32_t& state = states[i % kStates];
    if (state >= uint64_t(kLowState) * f << (16 - kScaleBits)) {
      words.push_back(uint16_t(state));
      state >>= 16;
    }
    state = (state / f << kScaleBits) + state % f + start[splits[i].symbol];
  }
  std::string out;
  for (const uint32_t state : states) putWord(out, state, kStateBytes);
  for (size_t i = words.size(); i-- > 0;) putWord(out, words[i], kWordBytes);
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

/// What the lowest bits of a state tell.
struct Slots {
  struct Slot {
    uint16_t frequency, rank;  ///< of the symbol; of the slot among the symbol's
    uint8_t symbol;
  };
  struct Symbol {
    uint64_t base;
    int bits;
  };
  std::array<Slot, kScale> slots;
  std::array<Symbol, kSymbols> symbols;

  explicit Slots(const Frequencies& frequency) {
    size_t at = 0;
    for (size_t s = 0; s < kSymbols; ++s) {
      symbols[s] = {base(s), splitOf(s).bits};
      for (uint32_t rank = 0; rank < frequency[s]; ++rank) slots[at++] = {uint16_t(frequency[s]), uint16_t(rank), uint8_t(s)};
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

/// Bytes followed by enough padding that a reader need not look for the end before each integer, but only once at the end.
class Padded {
 public:
  Padded(std::vector<char>& buffer, std::string_view bytes, size_t padding) : size_(bytes.size()) {
    if (buffer.size() < bytes.size() + padding) buffer.resize(bytes.size() + padding);
    std::copy(bytes.begin(), bytes.end(), buffer.begin());
    bytes_ = buffer.data();
  }
  const char* at(size_t byte) const { return bytes_ + byte; }
  size_t size() const { return size_; }

 private:
  const char* bytes_;
  size_t size_;
};

/// The bits from a place on; moves the place past them.
uint64_t takeBits(const Padded& bytes, size_t& place, int bits) {
  constexpr int kMost = 57;  // as many as 8 bytes have from any bit of the first one on
  if (bits > kMost) {
    const uint64_t low = takeBits(bytes, place, 32);
    return low | takeBits(bytes, place, bits - 32) << 32;
  }
  const uint64_t word = loadScalar<uint64_t>(bytes.at(place / 8), ByteOrder::little) >> place % 8;
  place += size_t(bits);
  return word & ((uint64_t(1) << bits) - 1);
}

void unpack(const Slots& slots, const Padded& symbols, const Padded& bits, std::vector<uint64_t>& block) {
  if (symbols.size() < kStates * kStateBytes) throw Damaged{kBadBlock};
  std::array<uint32_t, kStates> states;
  for (size_t i = 0; i < kStates; ++i) states[i] = loadScalar<uint32_t>(symbols.at(kStateBytes * i), ByteOrder::little);
  size_t at = kStates * kStateBytes, place = 0;
  const auto next = [&](uint32_t& state) {
    const Slots::Slot slot = slots.slots[state % kScale];
    const Slots::Symbol& symbol = slots.symbols[slot.symbol];
    state = slot.frequency * (state >> kScaleBits) + slot.rank;
    const uint32_t refilled = state << 16 | loadScalar<uint16_t>(symbols.at(at), ByteOrder::little);
    at += state < kLowState ? kWordBytes : 0;
    state = state < kLowState ? refilled : state;
    return symbol.base | takeBits(bits, place, symbol.bits);
  };
  const Slots::Slot first = slots.slots[states[0] % kScale];
  if (first.frequency == kScale && slots.symbols[first.symbol].bits == 0) {
    std::fill(block.begin(), block.end(), slots.symbols[first.symbol].base);
  } else {
    size_t i = 0;
    for (; i + kStates <= block.size(); i += kStates) {
      for (size_t k = 0; k < kStates; ++k) block[i + k] = next(states[k]);
    }
    for (size_t k = 0; i < block.size(); ++i, ++k) block[i] = next(states[k]);
  }
  const bool isLow = std::all_of(states.begin(), states.end(), [](uint32_t state) { return state == kLowState; });
  const bool allBits = (place + 7) / 8 == bits.size() && (place % 8 == 0 || uint8_t(*bits.at(place / 8)) >> place % 8 == 0);
  if (!isLow || at != symbols.size() || !allBits) throw Damaged{kBadBlock};
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
  const std::string_view symbols = takeBytes(bytes_, takeLength(bytes_)), bits = takeBytes(bytes_, takeLength(bytes_));
  block_.resize(size_t(count));
  unpack(slots, Padded(symbols_, symbols, kWordBytes * (count + 1)), Padded(bits_, bits, sizeof(uint64_t) * (count + 1)), block_);
  next_ = 0;
}

void IntegerReader::expect(uint64_t count) const {
  constexpr uint64_t kSmallestBlock = 22;  // of one symbol: count, frequencies, states and two lengths
  const uint64_t blocks = bytes_.size() / kSmallestBlock;
  if (count > block_.size() - next_ + blocks * IntegerWriter::kBlock) throw Damaged{"is said to be longer than its bytes can be"};
}

void IntegerReader::finish() const {
  if (next_ != block_.size() || !bytes_.empty()) throw Damaged{"has more entries than it is said to have"};
}

}  // namespace mandoline::detail
