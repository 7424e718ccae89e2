// The sentences in which checks say what is wrong.
#include "operators/validate/tally.h"

#include <cctype>
#include <cmath>

namespace mandoline::validation {
namespace {

/// "0.3%": what goes after "by".
std::string inWords(double share) {
  if (std::isnan(share)) return "an amount that can't be computed";
  const double percent = 100 * share;
  if (percent > 1000) return "more than 1000%";
  if (percent < 0.01) return "less than 0.01%";
  // Two digits, in any locale.
  int64_t unit = 1;
  while (percent * double(unit) < 10) unit *= 10;
  const int64_t units = std::llround(percent * double(unit));
  std::string text = std::to_string(units / unit), fraction = std::to_string(unit + units % unit);  // a 1, then the fraction's digits
  while (fraction.back() == '0') fraction.pop_back();
  if (fraction.size() > 1) {
    fraction[0] = '.';
    text += fraction;
  }
  return text + '%';
}

/// "Face 12". There is only one grid and one mesh, and for arrays the text says which.
std::string subject(const std::string& kind, int64_t element) {
  if (kind == "grid" || kind == "mesh") return "The " + kind;
  if (kind == "array") return "An array";
  std::string words = kind + " " + std::to_string(element);
  words[0] = char(std::toupper(words[0]));
  return words;
}

}  // namespace

void Tally::violate(const char* kind, int64_t element, const char* text) {
  if (check_.worst++ == 0) keep(kind, element, text);
}

void Tally::measure(const Deviation& deviation, const char* kind, int64_t element, const char* text) {
  if (deviation.roundings <= check_.worst || std::isnan(check_.worst)) return;
  check_.worst = deviation.roundings;
  share_ = deviation.share;
  keep(kind, element, text);
}

void Tally::merge(const Tally& next) {
  if (next.check_.elementKind.empty()) return;
  const char* kind = next.check_.elementKind.c_str();
  if (check_.tolerance > 0) {
    measure({next.check_.worst, next.share_}, kind, next.check_.element, next.text_);
  } else {
    if (check_.worst == 0) keep(kind, next.check_.element, next.text_);
    check_.worst += next.check_.worst;
  }
}

void Tally::keep(const char* kind, int64_t element, const char* text) {
  check_.elementKind = kind, check_.element = element;
  text_ = text;
}

std::string Tally::sentence() const {
  std::string text = subject(check_.elementKind, check_.element) + " " + text_;
  const size_t place = text.find("{}");
  if (place != std::string::npos) text.replace(place, 2, inWords(share_));
  if (place != std::string::npos && share_ < 1e-4) text += ", more than rounding explains";
  text += ".";
  if (check_.tolerance == 0 && check_.worst > 1) text += " There are " + std::to_string(int64_t(check_.worst)) + " violations in all.";
  return text;
}

Check Tally::finish(const std::string& leftOut) const {
  Check check = check_;
  check.pass = check.skipped || check.worst <= check.tolerance;
  if (!check.pass) {
    check.message = sentence();
  } else if (!check.skipped) {
    check.message = leftOut;
  }
  return check;
}

std::string counted(uint64_t count, const std::string& noun) { return std::to_string(count) + " " + noun + (count == 1 ? "" : "s"); }

}  // namespace mandoline::validation
