// Follows a flow from cell to cell.
//
// In a cell the velocity is linear, and a step ends where it meets a side of the block that holds the member: points on it have the
// plane's coordinate exactly. Only triangles divide a block, and no step meets one, so the member stays the same until then. Where the
// velocities of two cells both point at the side between them, the line slides along it.
#pragma once

#include "operators/locate/walls.h"
#include "physics/flow_field.h"
#include "physics/obstacles.h"

namespace mandoline::physics {

class Tracer {
 public:
  /// Keeps references to all.
  Tracer(const FlowField& field, const FieldMembers& members, const Obstacles& obstacles, const StreamlineOptions& options);

  /// Appends the line from a seed, which lies in the member.
  void trace(const Point& seed, size_t member, Streamlines& lines);

 private:
  /// A side of the member's box: the lower or upper one across an axis.
  struct Side {
    size_t axis;
    bool upper;
  };
  struct Step {
    Point to;
    double error;  ///< of the end or of the chord, if that is larger
  };

  void enter(size_t member);
  bool goOn();
  bool isOutward(size_t axis, const Point& v) const;
  bool meetSide(size_t axis, const Point& v);
  bool cross(const Side& side);
  int64_t memberAcross(const Side& side, const operators::GridCell& at);
  std::vector<size_t> joinedAcross(const Side& side, const IdRange& range) const;
  Point velocity(const Point& p) const;
  Step stepOf(double time) const;
  bool move(const Point& v);
  double shareInside(const Point& to, size_t& axis) const;
  bool advance(Point to);
  bool getsNowhere();
  void push(const Point& p);
  bool end(StreamlineEnd why) {
    end_ = why;
    return false;
  }

  const FlowField& field_;
  const FieldMembers& members_;
  const Obstacles& obstacles_;
  const StreamlineOptions& options_;
  operators::ScaledSpace space_;
  operators::Walls walls_;
  detail::Predicates predicates_;
  double slowest_;  ///< anything slower counts as at rest

  Streamlines* lines_ = nullptr;
  StreamlineEnd end_{};
  size_t member_ = 0, cell_ = 0;
  operators::GridCell corner_{}, past_{};  ///< of the member's box
  Point low_{}, high_{};
  double size_ = 0;  ///< the box's longest side
  Point at_{};
  double time_ = 0;  ///< of the next step; 0 for none yet
  double length_ = 0;
  Point mark_{};  ///< where the line was a while ago, and how long
  double markLength_ = 0;
  int sinceMark_ = 0;                       ///< steps
  std::array<bool, 3> crossed_{}, held_{};  ///< at this point: axes whose side has been crossed, and that the line slides across
};

}  // namespace mandoline::physics
