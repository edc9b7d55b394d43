// SPDX-License-Identifier: MIT
#include "broadphase/proximity_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/proximity_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "broadphase/proximity_answers-inl.h"

#if HWY_ONCE

namespace throng::broadphase {

HWY_EXPORT(SearchMany);
HWY_EXPORT(SearchAll);
HWY_EXPORT(SearchBest);

void search(const ProximityTree& tree, const Near& near, Answers& answers) {
  HWY_DYNAMIC_DISPATCH(SearchMany)(tree, near, answers);
}

void search(const ProximityTree& tree, const Question& question, const Near& near, NeighbourCall call,
            void* context) {
  HWY_DYNAMIC_DISPATCH(SearchAll)(tree, question, near, call, context);
}

std::size_t search(const ProximityTree& tree, const Question& question, const Near& near, Neighbour* best) {
  return HWY_DYNAMIC_DISPATCH(SearchBest)(tree, question, near, best);
}

}  // namespace throng::broadphase

#endif
