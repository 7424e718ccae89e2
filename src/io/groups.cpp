#include "io/groups.h"

#include <algorithm>
#include <set>

#include "operators/require_cut_mesh.h"

namespace mandoline::detail {
namespace {

bool isLetter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
bool isInPatchName(char c) { return isLetter(c) || ('0' <= c && c <= '9') || std::string_view("-.:%+").find(c) != std::string_view::npos; }
bool isInObjName(char c) { return std::string_view(" \t\v\f\r\n").find(c) == std::string_view::npos; }

/// The name with '_' for each run of characters that a word can't have; if it can't begin a word, it gets a '_' in front.
std::string wordOf(const std::string& name, bool (*isInWord)(char), bool (*beginsWord)(char)) {
  std::string word;
  bool replaced = false;
  for (const char c : name) {
    if (isInWord(c)) word += c;
    if (!isInWord(c) && !replaced) word += '_';
    replaced = !isInWord(c);
  }
  return !word.empty() && beginsWord(word[0]) ? word : '_' + word;
}

std::vector<std::string> uniqueWords(std::span<const std::string> names, bool (*isInWord)(char), bool (*beginsWord)(char),
                                     std::span<const char* const> reserved) {
  std::set<std::string> taken(reserved.begin(), reserved.end());
  std::vector<std::string> words;
  std::vector<bool> stays;
  for (const std::string& name : names) {
    words.push_back(wordOf(name, isInWord, beginsWord));
    stays.push_back(words.back() == name && taken.insert(name).second);
  }
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i];
    for (int number = 2; !stays[i] && !taken.insert(words[i]).second; ++number) words[i] = word + '_' + std::to_string(number);
  }
  return words;
}

}  // namespace

const TriangleGroups* checkedGroups(const TriangleGroups* groups, size_t triangles) {
  if (!groups || groups->empty()) return nullptr;
  const auto isGroup = [&](uint32_t group) { return group < groups->names.size(); };
  if (groups->triangleGroup.size() != triangles || !std::all_of(groups->triangleGroup.begin(), groups->triangleGroup.end(), isGroup)) {
    operators::refuse("groups must name one of its groups for each of the mesh's " + std::to_string(triangles) + " triangles.");
  }
  return groups;
}

std::vector<std::string> patchNames(std::span<const std::string> names, std::span<const char* const> reserved) {
  return uniqueWords(names, isInPatchName, isLetter, reserved);
}

std::vector<std::string> objNames(std::span<const std::string> names) { return uniqueWords(names, isInObjName, isInObjName, {}); }

}  // namespace mandoline::detail
