#include "operators/validate/exact_places.h"

#include "operators/validate/place_finder.h"

namespace mandoline::validation {
/// Each number is converted once.
void ExactPlaces::convert(const Context& context) {
  for (int d = 0; d < 3; ++d) axialPlanes_[size_t(d)].assign(context.planes()[size_t(d)].begin(), context.planes()[size_t(d)].end());
  triVertices_.resize(context.mesh.vertexCount());
  for (uint32_t v = 0; v < triVertices_.size(); ++v) {
    const Vec3 p = finiteTriVertex(context, v);
    triVertices_[v] = {p[0], p[1], p[2]};
  }
  const Finder<Residue> finder(context);
  triPlanes_.resize(context.mesh.triangleCount());
  for (size_t t = 0; t < triPlanes_.size(); ++t) triPlanes_[t] = finder.planeOf(t);
}

/// One inverse is enough: that of the product of all divisors.
ExactPlaces::ExactPlaces(const Context& context) {
  convert(context);
  const Finder<Residue> finder(context);
  const uint32_t count = uint32_t(context.cut.vertexCount());
  std::vector<Residue> divisors(count), products(size_t(count) + 1);
  places_.resize(count);
  known_.resize(count);
  products[0] = 1;
  for (uint32_t v = 0; v < count; ++v) {
    const auto q = finder.placeOf(v);
    known_[v] = !q.w.isZero();
    places_[v] = q.x;
    divisors[v] = known_[v] ? q.w : Residue(1);
    products[v + 1] = products[v] * divisors[v];
  }
  Residue inverse = products[count].inverse();
  for (uint32_t v = count; v-- > 0;) {
    places_[v] = (inverse * products[v]) * places_[v];
    inverse = inverse * divisors[v];
  }
}

}  // namespace mandoline::validation
