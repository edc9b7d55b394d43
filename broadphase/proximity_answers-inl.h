// SPDX-License-Identifier: MIT
// What becomes of that which a search meets, and the three ways to ask; see proximity_search-inl.h.
#if defined(THRONG_PROXIMITY_ANSWERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_PROXIMITY_ANSWERS_INL
#undef THRONG_PROXIMITY_ANSWERS_INL
#else
#define THRONG_PROXIMITY_ANSWERS_INL
#endif

#include <algorithm>
#include <bit>
#include <limits>

#include "broadphase/best_few.h"
#include "broadphase/proximity_keep-inl.h"
#include "broadphase/proximity_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Calls for all, as met.
template <class S>
struct CallAll {
  double limit() const { return limit_; }
  void take(Mask mask, Reals key, Rows rows) const {
    alignas(64) double keys[kLanes];
    alignas(64) std::uint64_t who[kLanes];
    hn::Store(key, D(), keys);
    hn::Store(rows, U(), who);
    for (std::uint32_t left = S::bits(mask); left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      call(context, static_cast<std::uint32_t>(who[i]), S::distance(keys[i]));
    }
  }
  double limit_;
  NeighbourCall call;
  void* context;
};

/// Keeps the nearest few.
template <class S>
struct KeepBest {
  double limit() const { return limit_; }
  /// Than anything whose key is no less than `key` and whose row no lower than `row`.
  HWY_INLINE bool has_better(double key, std::uint32_t row) const {
    return best.full() && row > best.last().row && S::distance(key) >= best.last().distance;
  }
  HWY_INLINE void take(Mask mask, Reals key, Rows rows) {
    std::uint32_t left = S::bits(mask);
    if (left == 0) return;
    alignas(64) double keys[kLanes];
    alignas(64) std::uint64_t who[kLanes];
    hn::Store(key, D(), keys);
    hn::Store(rows, U(), who);
    for (; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      if (keys[i] > limit_) continue;
      if (best.add({static_cast<std::uint32_t>(who[i]), S::distance(keys[i])}) && best.full())
        limit_ = std::min(limit_, S::distance_key(best.last().distance));
    }
  }
  double limit_;
  BestFew best;
};

/// About the k-th smallest of a list of squares or distances, and no less, by halving an interval: its end
/// always has k below it. Expects a list of at least k > 0, with room for a vector behind it.
HWY_INLINE double about_smallest(std::size_t k, double* list, std::size_t count) {
  constexpr int kHalvings = 12;
  for (std::size_t i = count; i % kLanes != 0; ++i) list[i] = std::numeric_limits<double>::infinity();
  Reals least = hn::LoadU(D(), list), most = hn::Set(D(), list[0]);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Reals own = hn::LoadU(D(), list + i);
    least = hn::Min(least, own);
    most = hn::Max(most,
                   hn::IfThenElse(hn::Le(own, hn::Set(D(), std::numeric_limits<double>::max())), own, most));
  }
  double low = hn::GetLane(hn::MinOfLanes(D(), least)), high = hn::GetLane(hn::MaxOfLanes(D(), most));
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = low + 0.5 * (high - low);
    std::size_t below = 0;
    for (std::size_t j = 0; j < count; j += kLanes)
      below += hn::CountTrue(D(), hn::Le(hn::LoadU(D(), list + j), hn::Set(D(), middle)));
    (below >= k ? high : low) = middle;
    if (below >= k && below <= k + k / 16) break;
  }
  return high;
}

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// The largest key that an answer can have. Where a few of many are asked for, those beside the place along
/// the curve say how far away the last one is at most; kUnknown where they are too few, or many are asked
/// for.
template <class S>
double last_key(const ProximityTree& tree, const Question& question, const Near& near, Answers& answers) {
  constexpr std::size_t kFew = 64;  // beyond, the nearest are better kept in a heap
  const double radius_key = S::radius_key(question.radius);
  if (near.most >= tree.size()) return radius_key;
  if (near.most > kFew) return kUnknown;
  KeepAll sink{radius_key, answers};
  S(tree, question, near).meet_around(question.leaf, near.most, sink);
  if (sink.count < near.most) return kUnknown;
  const double farthest = S::distance(about_smallest(near.most, answers.key.data(), sink.count));
  return std::min(radius_key, S::distance_key(farthest));
}

template <class S>
void answer_by_heap(const ProximityTree& tree, const Question& question, const Near& near, Answers& answers) {
  answers.best.resize(std::max(answers.best.size(), near.most));
  KeepBest<S> sink{S::radius_key(question.radius), BestFew(answers.best.data(), near.most)};
  S(tree, question, near).run_nearest_first(sink);
  append(answers.best.data(), sink.best.finish(), answers);
}

constexpr std::size_t kMostToSort = 512;  // for a few: more are equally near, and only the heap looks at rows
constexpr std::size_t kTogether = 8;      // questions that share the search of the tree's upper part

/// Answers at most kTogether questions.
template <class S>
void answer(const ProximityTree& tree, std::span<const Question> questions, const Near& near,
            Answers& answers) {
  double key[kTogether], largest = kUnknown;
  Box places;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    key[i] = last_key<S>(tree, questions[i], near, answers);
    if (key[i] == kUnknown) continue;
    largest = std::max(largest, key[i]);
    places.extend(questions[i].at);
  }
  const bool shared =
      largest != kUnknown && typename S::UpperPart(tree, places, largest, answers.parents).run();
  const std::size_t most_to_sort = near.most < tree.size() ? kMostToSort : KeepAll::kAny;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const std::size_t before = answers.size;
    if (key[i] == kUnknown) {
      answer_by_heap<S>(tree, questions[i], near, answers);
    } else {
      const S search(tree, questions[i], near);
      KeepAll sink{key[i], answers, most_to_sort};
      if (shared)
        search.run(answers.parents, sink);
      else
        search.run(sink);
      if (sink.full())
        answer_by_heap<S>(tree, questions[i], near, answers);
      else
        append_sorted<S::kSquares>(sink.count, answers);
      answers.size = std::min(answers.size, before + std::min(near.most, tree.size()));
    }
    answers.count.push_back(static_cast<std::uint32_t>(answers.size - before));
  }
}

/// Calls `f` with the search that suits the tree.
template <class F>
HWY_INLINE void choose(const ProximityTree& tree, F&& f) {
  using Kind = ProximityTree::Kind;
  if (tree.kind == Kind::boxes)
    f(static_cast<Search<Plane, Kind::boxes>*>(nullptr));
  else if (tree.kind == Kind::discs && tree.periodic)
    f(static_cast<Search<Torus, Kind::discs>*>(nullptr));
  else if (tree.kind == Kind::discs)
    f(static_cast<Search<Plane, Kind::discs>*>(nullptr));
  else if (tree.periodic)
    f(static_cast<Search<Torus, Kind::points>*>(nullptr));
  else
    f(static_cast<Search<Plane, Kind::points>*>(nullptr));
}

void SearchMany(const ProximityTree& tree, const Near& near, Answers& answers) {
  const std::span<const Question> questions = answers.questions;
  choose(tree, [&]<class S>(S*) HWY_ATTR {
    for (std::size_t i = 0; i < questions.size(); i += kTogether)
      answer<S>(tree, questions.subspan(i, std::min(kTogether, questions.size() - i)), near, answers);
  });
}

void SearchAll(const ProximityTree& tree, const Question& question, const Near& near, NeighbourCall call,
               void* context) {
  choose(tree, [&]<class S>(S*) HWY_ATTR {
    CallAll<S> sink{S::radius_key(question.radius), call, context};
    S(tree, question, near).run(sink);
  });
}

std::size_t SearchBest(const ProximityTree& tree, const Question& question, const Near& near,
                       Neighbour* best) {
  std::size_t count = 0;
  choose(tree, [&]<class S>(S*) HWY_ATTR {
    KeepBest<S> sink{S::radius_key(question.radius), BestFew(best, near.most)};
    S(tree, question, near).run_nearest_first(sink);
    count = sink.best.finish();
  });
  return count;
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
