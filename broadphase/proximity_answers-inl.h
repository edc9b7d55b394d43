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
#include "broadphase/proximity_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// Keeps all, as met, with room for a vector behind the last one.
struct KeepAll {
  double limit() const { return limit_; }
  HWY_INLINE void take(Mask mask, Reals key, Rows rows) {
    if (count + 2 * kLanes > answers.key.size()) grow();
    hn::CompressBlendedStore(key, mask, D(), answers.key.data() + count);
    count += hn::CompressBlendedStore(rows, hn::RebindMask(U(), mask), U(), answers.who.data() + count);
  }
  HWY_NOINLINE void grow() {
    answers.key.resize(2 * count + 64);
    answers.who.resize(2 * count + 64);
  }
  double limit_;
  Answers& answers;
  std::size_t count = 0;
};

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
        limit_ = std::min(limit_, S::distance_key(best.farthest()));
    }
  }
  double limit_;
  BestFew best;
};

/// Appends what was found in order of (distance, row), by counting for each how many come before it, which
/// takes no branches. False where two are equally near: then what was written is to be written again.
HWY_INLINE bool append_ranked(std::size_t count, const double* distance, const std::uint64_t* who,
                              std::uint32_t* row_out, double* distance_out) {
  constexpr double kSelf = 4096.0;  // more than any rank
  const Reals one = hn::Set(D(), 1.0), self = hn::Set(D(), kSelf);
  bool distinct = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Reals own = hn::Set(D(), distance[i]);
    Reals sum = hn::Zero(D());
    for (std::size_t j = 0; j < count; j += kLanes) {
      const Reals other = hn::LoadU(D(), distance + j);
      const Reals equal = hn::IfThenElseZero(hn::Eq(other, own), self);
      sum = hn::Add(sum, hn::IfThenElse(hn::Lt(other, own), one, equal));
    }
    const double rank = hn::GetLane(hn::SumOfLanes(D(), sum)) - kSelf;
    distinct = distinct && rank < kSelf;
    const auto place = static_cast<std::size_t>(rank) % count;
    row_out[place] = static_cast<std::uint32_t>(who[i]);
    distance_out[place] = distance[i];
  }
  return distinct;
}

void reserve(Answers& answers, std::size_t more) {
  if (answers.size + more <= answers.row.size()) return;
  answers.row.resize(2 * (answers.size + more));
  answers.distance.resize(2 * (answers.size + more));
}

void append(const Neighbour* list, std::size_t count, Answers& answers) {
  reserve(answers, count);
  for (std::size_t i = 0; i < count; ++i) {
    answers.row[answers.size + i] = list[i].row;
    answers.distance[answers.size + i] = list[i].distance;
  }
  answers.size += count;
}

template <class S>
void append_sorted(std::size_t count, Answers& answers) {
  constexpr std::size_t kFewToRank = 128;  // counting is quadratic
  double* const keys = answers.key.data();
  if (count == 0) return;
  for (std::size_t i = count; i % kLanes != 0; ++i) keys[i] = std::numeric_limits<double>::infinity();
  if constexpr (S::kSquares)
    for (std::size_t i = 0; i < count; i += kLanes)
      hn::StoreU(hn::Sqrt(hn::LoadU(D(), keys + i)), D(), keys + i);
  reserve(answers, count);
  if (count <= kFewToRank && append_ranked(count, keys, answers.who.data(), answers.row.data() + answers.size,
                                           answers.distance.data() + answers.size)) {
    answers.size += count;
    return;
  }
  answers.best.resize(std::max(answers.best.size(), count));
  for (std::size_t i = 0; i < count; ++i)
    answers.best[i] = {static_cast<std::uint32_t>(answers.who[i]), keys[i]};
  std::sort(answers.best.begin(), answers.best.begin() + static_cast<std::ptrdiff_t>(count), nearer);
  append(answers.best.data(), count, answers);
}

/// The k-th smallest of a list, k > 0, by counting for each how many are no larger. Expects a list of at
/// least k, with room for a vector behind it.
HWY_INLINE double smallest(std::size_t k, double* list, std::size_t count) {
  for (std::size_t i = count; i % kLanes != 0; ++i) list[i] = std::numeric_limits<double>::infinity();
  const Reals one = hn::Set(D(), 1.0);
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    Reals sum = hn::Zero(D());
    for (std::size_t j = 0; j < count; j += kLanes)
      sum = hn::Add(sum, hn::IfThenElseZero(hn::Le(hn::LoadU(D(), list + j), hn::Set(D(), list[i])), one));
    const bool enough = hn::GetLane(hn::SumOfLanes(D(), sum)) >= static_cast<double>(k);
    result = enough && list[i] < result ? list[i] : result;
  }
  return result;
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
  const double farthest = S::distance(smallest(near.most, answers.key.data(), sink.count));
  return std::min(radius_key, S::distance_key(farthest));
}

template <class S>
void answer_by_heap(const ProximityTree& tree, const Question& question, const Near& near, Answers& answers) {
  answers.best.resize(std::max(answers.best.size(), near.most));
  KeepBest<S> sink{S::radius_key(question.radius), BestFew(answers.best.data(), near.most)};
  S(tree, question, near).run_nearest_first(sink);
  append(answers.best.data(), sink.best.finish(), answers);
}

constexpr std::size_t kTogether = 8;  // questions that share the search of the tree's upper part

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
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const std::size_t before = answers.size;
    if (key[i] == kUnknown) {
      answer_by_heap<S>(tree, questions[i], near, answers);
    } else {
      const S search(tree, questions[i], near);
      KeepAll sink{key[i], answers};
      if (shared)
        search.run(answers.parents, sink);
      else
        search.run(sink);
      append_sorted<S>(sink.count, answers);
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

void SearchMany(const ProximityTree& tree, std::span<const Question> questions, const Near& near,
                Answers& answers) {
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
