// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "narrowphase/manifold.h"
#include "sim/state.h"

namespace throng {

/// The contacts of the last step that pressed. They and the questions ascend by key: the search never goes
/// back.
class KeptImpulses {
 public:
  /// Keys below `first` won't be asked for.
  explicit KeptImpulses(std::span<const ContactImpulse> kept, std::uint64_t first = 0) : kept_(kept) {
    const auto below = [](const ContactImpulse& contact, std::uint64_t key) { return contact.key < key; };
    next_ = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), first, below) - kept.begin());
  }

  /// The first contact under that key; null where nothing pressed.
  const ContactImpulse* find(std::uint64_t key) {
    while (next_ < kept_.size() && kept_[next_].key < key) ++next_;
    return next_ < kept_.size() && kept_[next_].key == key ? &kept_[next_] : nullptr;
  }

  /// The contact with that key and feature, whichever face described it; null where it didn't press.
  const ContactImpulse* find(std::uint64_t key, std::uint32_t feature) {
    if (!find(key)) return nullptr;
    const std::uint32_t touch = narrowphase::without_reference(feature);
    for (std::size_t i = next_; i < kept_.size() && kept_[i].key == key; ++i)
      if (narrowphase::without_reference(kept_[i].feature) == touch) return &kept_[i];
    return nullptr;
  }

 private:
  std::span<const ContactImpulse> kept_;
  std::size_t next_;
};

}  // namespace throng
