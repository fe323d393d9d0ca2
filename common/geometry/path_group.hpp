#pragma once

// # Paths that wait for each other
//
// A path is written as one story: a ray, a hit, the next ray. A processor
// that follows one such story spends most of its time waiting for the last
// number before it can work out the next. Sixteen stories that are told in
// turns keep it busy.
//
// So each path has a stack of its own, on which its functions keep what they
// know, and the thread goes from one stack to the next whenever a path asks
// what its ray meets. Such a stack is called a fiber. Nothing happens at the
// same time: paths take turns in a fixed order, on one thread, so there is
// nothing to lock. And no path is written differently for it.
//
// Leaving one stack for another takes a few instructions that C++ has no
// words for, so a library does it: the lowest layer of Boost.Context. Without
// the library paths are followed one after the other, as they are in builds
// for debugging, where whoever steps through a path wants to stay on it. The
// picture has the same bits.

#include <functional>

#include "common/geometry/inlining.hpp"
#include "common/geometry/ray_packet.hpp"

#ifdef LIGHTWALK_FIBERS
#include <array>
#include <boost/context/detail/fcontext.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <cstddef>
#endif

namespace lightwalk {

#ifdef LIGHTWALK_FIBERS

// ## A ring
//
// The fibers stand in a ring, and each hands on to the next. So does the one
// that started them all: between the last path and the first it is its turn,
// and it answers what all of them have asked. A path that has come to its end
// leaves the ring, and when nobody else is left in it the work is done.

/// Sixteen fibers of this thread, which share one packet of rays.
class PathGroup {
 public:
  inline PathGroup();
  inline ~PathGroup();
  PathGroup(const PathGroup&) = delete;
  PathGroup& operator=(const PathGroup&) = delete;

  /// Runs `work` on all fibers, in turns, until each of them has returned
  /// from it. Whenever all wait for what their rays meet, `answer` is called
  /// with the packet of them.
  template <class Answer>
  void run(const std::function<void()>& work, Answer answer);

  // #region turns
  /// What the ray of the current path meets. Meanwhile other paths go on.
  FirstShape meet(const Ray& ray) {
    const Fiber self = *current_;
    self.row->put(self.lane, ray);
    go_to(*self.next);
    return self.row->first(self.lane);
  }

 private:
  struct Fiber {
    boost::context::detail::fcontext_t left_at;  ///< where it goes on
    Fiber* next;                                 ///< in the ring
    RayPacket::Row* row;
    int lane;
  };

  /// Leaves the current fiber, and returns when its turn comes again.
  void go_to(Fiber& other) {
    Fiber* const self = current_;
    current_ = &other;
    has_come(boost::context::detail::jump_fcontext(other.left_at, self));
  }

  /// Notes where the fiber that was left last can go on.
  static void has_come(boost::context::detail::transfer_t from) {
    static_cast<Fiber*>(from.data)->left_at = from.fctx;
  }
  // #endregion turns

  [[noreturn]] static inline void start(
      boost::context::detail::transfer_t from);
  inline void leave_ring(const Fiber& fiber);

  const std::function<void()>* work_ = nullptr;
  RayPacket packet_;
  std::array<Fiber, RayPacket::size + 1> ring_;  // the last one: run()'s own
  Fiber* current_ = nullptr;
  std::array<boost::context::stack_context, RayPacket::size> stacks_;
};

/// The paths that this thread follows in turns; null if it follows one.
inline constinit thread_local PathGroup* path_group = nullptr;

template <class Answer>
void PathGroup::run(const std::function<void()>& work, Answer answer) {
  work_ = &work;
  for (std::size_t i = 0; i < ring_.size(); ++i)
    ring_[i].next = &ring_[(i + 1) % ring_.size()];
  Fiber& self = ring_.back();
  current_ = &self;
  path_group = this;
  for (go_to(*self.next); self.next != &self; go_to(*self.next))
    answer(packet_);
  path_group = nullptr;
}

/// What a fiber does from its first turn on.
void PathGroup::start(boost::context::detail::transfer_t from) {
  has_come(from);
  PathGroup& group = *path_group;
  for (;;) {
    (*group.work_)();
    group.leave_ring(*group.current_);
    group.go_to(*group.current_->next);
  }
}

void PathGroup::leave_ring(const Fiber& fiber) {
  Fiber* before = fiber.next;
  while (before->next != &fiber) before = before->next;
  before->next = fiber.next;
}

// ## The stacks
//
// Each has room for path tracers that are written as recursive functions, and
// a page at its end that nobody may touch. Memory that no path reaches is
// never taken from the system.
//
// Addresses that are 4 KiB apart share the same few places in a processor's
// first cache, and so the tops of sixteen stacks would drive each other out
// of it. So each begins a few cache lines lower than the one before.

inline constexpr std::size_t stack_bytes = 1 << 20;
inline constexpr std::size_t stack_shift = 13 * 64;

PathGroup::PathGroup() {
  boost::context::protected_fixedsize_stack memory(stack_bytes);
  for (int i = 0; i < RayPacket::size; ++i) {
    const auto path = static_cast<std::size_t>(i);
    stacks_[path] = memory.allocate();
    const std::size_t shift = path * stack_shift;
    ring_[path] = {boost::context::detail::make_fcontext(
                       static_cast<char*>(stacks_[path].sp) - shift,
                       stacks_[path].size - shift, start),
                   nullptr, &packet_.rows[path / lane_count], i % lane_count};
  }
}

PathGroup::~PathGroup() {
  boost::context::protected_fixedsize_stack memory(stack_bytes);
  for (auto& stack : stacks_) memory.deallocate(stack);
}

#else

/// There is none: each path has the thread to itself.
struct PathGroup {
  static FirstShape meet(const Ray&) { return {infinity, 0}; }
};
inline constexpr PathGroup* path_group = nullptr;

#endif

/// Runs `work` so that several paths of this thread can take turns in it,
/// where `answer(packet)` finds what a packet of rays meets.
template <class Answer>
void run_in_turns(const std::function<void()>& work, Answer answer) {
#ifdef LIGHTWALK_FIBERS
  thread_local PathGroup group;
  group.run(work, answer);
#else
  static_cast<void>(answer);
  work();
#endif
}

}  // namespace lightwalk
