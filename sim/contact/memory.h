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
class Memory {
 public:
  /// Keys below `first` won't be asked for.
  explicit Memory(std::span<const ContactImpulse> kept, std::uint64_t first = 0) : kept_(kept) {
    const auto below = [](const ContactImpulse& contact, std::uint64_t key) { return contact.key < key; };
    next_ = static_cast<std::size_t>(std::lower_bound(kept.begin(), kept.end(), first, below) - kept.begin());
  }

  /// Those under that key, one behind the other; none where nothing pressed.
  std::span<const ContactImpulse> find(std::uint64_t key) {
    while (next_ < kept_.size() && kept_[next_].key < key) ++next_;
    std::size_t end = next_;
    while (end < kept_.size() && kept_[end].key == key) ++end;
    return kept_.subspan(next_, end - next_);
  }

 private:
  std::span<const ContactImpulse> kept_;
  std::size_t next_;
};

/// The one of those contacts of a pair at which the same features touch; null where there is none.
inline const ContactImpulse* recall(std::span<const ContactImpulse> kept, std::uint32_t feature) {
  const std::uint32_t touch = narrowphase::without_reference(feature);
  for (const ContactImpulse& contact : kept)
    if (narrowphase::without_reference(contact.feature) == touch) return &contact;
  return nullptr;
}

}  // namespace throng
