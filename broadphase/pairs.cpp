// SPDX-License-Identifier: MIT
#include "broadphase/pairs.h"

namespace throng::broadphase {

void PairList::reset(std::size_t buffers) {
  if (buffers_.size() < buffers) buffers_.resize(buffers);
  count_ = buffers;
  for (std::size_t i = 0; i < count_; ++i) buffers_[i].clear();
}

std::size_t PairList::size() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < count_; ++i) sum += buffers_[i].size();
  return sum;
}

}  // namespace throng::broadphase
