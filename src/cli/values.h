// Values of options, from words.
#pragma once

#include <charconv>
#include <string_view>
#include <vector>

#include "cli/arguments.h"

namespace mandoline::cli {

/// The whole word as a number; false if it is not a number.
template <class Number>
bool parseNumber(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

/// Numbers with commas between them; empty if one of them is not a number.
template <class Number>
std::vector<Number> parseList(std::string_view word) {
  std::vector<Number> numbers;
  for (size_t begin = 0;;) {
    const size_t comma = word.find(',', begin);
    Number number;
    if (!parseNumber(word.substr(begin, comma - begin), number)) return {};
    numbers.push_back(number);
    if (comma == std::string_view::npos) return numbers;
    begin = comma + 1;
  }
}

// Each sets the value that the word says, or throws UsageError.
void parseCells(const std::string& word, GridArguments& grid);
void parseMargin(const std::string& word, GridArguments& grid);
void parseBox(const std::string& word, GridArguments& grid);
void parseOrigin(const std::string& word, GridArguments& grid);
void parseSpacing(const std::string& word, GridArguments& grid);
/// Lists for x, y and z with a '/' between them, or '@' and a file with a list on each of three lines.
void parsePlanes(const std::string& word, GridArguments& grid);
void parseOnly(const std::string& word, OnlyArguments& only);
void parseAxis(const std::string& word, SliceArguments& slice);
void parseNormal(const std::string& word, SliceArguments& slice);
void parseHeights(const std::string& word, SliceArguments& slice);
void parseLayers(const std::string& word, SliceArguments& slice);
void parseWind(const std::string& word, FlowArguments& flow);
void parseStreamlines(const std::string& word, FlowArguments& flow);
void parseCorrections(const std::string& word, FlowArguments& flow);
void parseSteps(const std::string& word, FlowArguments& flow);
void parseViscosity(const std::string& word, FlowArguments& flow);

// They throw UsageError for options that don't go together.
void checkGrid(const GridArguments& grid);
void checkSlice(const SliceArguments& slice, const OnlyArguments& only);
void checkFlow(const FlowArguments& flow);

}  // namespace mandoline::cli
