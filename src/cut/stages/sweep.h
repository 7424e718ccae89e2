// A polygon, however large, is taken apart by the planes of one axis.
#pragma once

#include <utility>

#include "cut/stages/polygon.h"

namespace mandoline::detail {

/// What pieces of a polygon are made in, one after the other.
using SweepRoom = std::array<CornerRow, 2>;

/// A convex polygon that is cut along an axis, from its lowest vertices up. Its outline ascends from there on two sides, which are walked
/// once for all planes: so a polygon across many planes costs what its pieces cost.
///
/// For each plane: climb(), then the vertices of the polygon's line in the plane are added to unfinished(), then close(), beginAbove().
class Sweep {
 public:
  Sweep(Polygon polygon, size_t axis, int32_t least, SweepRoom& room)
      : begin_(polygon.data()), end_(begin_ + polygon.size()), axis_(axis), piece_(&room[0]), next_(&room[1]), up_(begin_) {
    while (slab(up_) != least || slab(after(up_)) == least) ++up_;
    down_ = up_;
    while (slab(before(down_)) == least) down_ = before(down_);
    piece_->clear();
    piece_->makeRoom(polygon.size());
    for (const Corner* c = down_; c != up_; c = after(c)) piece_->add(*c);
    piece_->add(*up_);
  }

  /// Where the outline leaves the last plane upwards, counter-clockwise, and where it comes back.
  const Corner& up() const { return *up_; }
  const Corner& down() const { return *down_; }

  /// Goes on to a plane, which the polygon has been cut at along its outline.
  void climb(int32_t slabOfPlane) {
    while (slab(up_ = after(up_)) != slabOfPlane) piece_->add(*up_);
    lineFirst_ = piece_->size();
    base_ = down_;
    do down_ = before(down_);
    while (slab(down_) != slabOfPlane);
  }
  /// The piece below that plane, to which all vertices of its line in the plane are to be added, from up() to down(). There must be room
  /// for as many more as the polygon has.
  CornerRow& unfinished() { return *piece_; }
  /// Closes it.
  void close() {
    lineSize_ = piece_->size() - lineFirst_;
    for (const Corner* c = after(down_); c != base_; c = after(c)) piece_->add(*c);
  }
  /// The vertices of the line, its ends too.
  Polygon line() const { return piece().subspan(lineFirst_, lineSize_); }
  Polygon piece() const { return piece_->all(); }
  /// Begins the piece above that line; what climbs on goes on with it.
  void beginAbove() {
    next_->clear();
    next_->makeRoom(lineSize_ + size_t(end_ - begin_));
    const Corner* const first = line().data();
    for (const Corner* c = first + lineSize_; c != first;) next_->add(*--c);
    std::swap(piece_, next_);
  }
  /// Closes the piece above the last plane.
  void closeLast() {
    for (const Corner* c = after(up_); c != down_; c = after(c)) piece_->add(*c);
  }

 private:
  int32_t slab(const Corner* c) const { return c->slab[axis_]; }
  const Corner* after(const Corner* c) const { return c + 1 != end_ ? c + 1 : begin_; }
  const Corner* before(const Corner* c) const { return (c != begin_ ? c : end_) - 1; }

  const Corner *const begin_, *const end_;  // of the polygon
  const size_t axis_;
  CornerRow *piece_, *next_;
  const Corner *up_, *down_ = nullptr, *base_ = nullptr;
  size_t lineFirst_ = 0, lineSize_ = 0;  // in the piece
};

}  // namespace mandoline::detail
