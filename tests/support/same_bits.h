// Compares results to the bit: of cut-meshes every array, the grid and the counts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mandoline/mandoline.h"

template <class Number>
std::string bytesOf(const Number* numbers, size_t count) {
  return count == 0 ? std::string() : std::string(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}

/// All that a result has.
template <class Result>
std::string bytesOfFields(const Result& result) {
  std::string bytes;
  Result::fields(result, [&](const char*, const auto& field) {
    if constexpr (requires { field.fields(field, [](auto&&...) {}); }) {
      bytes += bytesOfFields(field);
    } else if constexpr (requires { field.data(); }) {
      bytes += bytesOf(field.data(), field.size());
    } else {
      bytes += bytesOf(&field, 1);
    }
  });
  return bytes;
}

inline std::vector<std::pair<std::string, std::string>> partsOf(const mandoline::CutMesh& mesh) {
  std::vector<std::pair<std::string, std::string>> parts;
  forEachArray(mesh, [&](const mandoline::ArrayInfo& info, const auto& array) {
    parts.emplace_back(info.name, bytesOf(array.data(), array.size()));
  });
  for (const auto& planes : mesh.grid.planes) parts.emplace_back("grid", bytesOf(planes.data(), planes.size()));
  parts.emplace_back("grid", bytesOf(mesh.grid.origin.data(), 3) + bytesOf(mesh.grid.spacing.data(), 3) + (mesh.grid.uniform ? "1" : "0"));
  parts.emplace_back("regionCount", std::to_string(mesh.regionCount));
  parts.emplace_back("hasWinding", std::to_string(mesh.hasWinding));
  parts.emplace_back("triangleCount", std::to_string(mesh.triangleCount));
  parts.emplace_back("snapTolerance", std::to_string(mesh.snapTolerance));
  parts.emplace_back("madeFrom", mesh.madeFrom.text());
  parts.emplace_back("fingerprint", mesh.fingerprint.text());
  return parts;
}

/// What differs, each named once.
inline std::vector<std::string> differences(const mandoline::CutMesh& a, const mandoline::CutMesh& b) {
  const auto first = partsOf(a), second = partsOf(b);
  std::vector<std::string> names;
  for (size_t i = 0; i < first.size(); ++i) {
    const bool isNew = names.empty() || names.back() != first[i].first;
    if (isNew && first[i].second != second[i].second) names.push_back(first[i].first);
  }
  return names;
}
