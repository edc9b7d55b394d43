// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/recording/h5.h"

/// Making groups, attributes and datasets that are complete when made. All throw h5::Error.
namespace throng::recording::h5 {

/// A file in the oldest format that holds it, so that every HDF5 reads it. Empties what is there.
Handle create_file(const std::string& path);

Handle create_group(hid_t at, const char* name);
Handle create_groups(hid_t at, const char* path);  ///< those on the way too, where they aren't there

void write_attribute(hid_t at, const char* name, std::string_view text);
void write_attribute(hid_t at, const char* name, const std::vector<std::string>& texts);
template <class T>
void write_attribute(hid_t at, const char* name, T value);
template <class T>
void write_attribute(hid_t at, const char* name, std::span<const T> values);

/// A scalar text of its own length. Unchecksummed: keep its hash elsewhere.
void write_text(hid_t at, const char* name, std::string_view text);

/// A list of texts, all padded to the longest, with fletcher32.
void write_texts(hid_t at, const char* name, const std::vector<std::string>& texts);

/// values[n * columns] as a dataset [n] or, with columns > 1, [n, columns]; with fletcher32 where it isn't
/// empty.
template <class T>
void write_array(hid_t at, const char* name, std::span<const T> values, hsize_t columns = 1);

/// What the numbers of a chunk go through; `packed` is shuffle, deflate and fletcher32.
enum class Filters { none, fletcher32, packed };

/// An empty dataset that grows in its first dimension; `dims` and `chunk` without it hold one row each. What
/// was never written reads as zeros. Expects chunks with filters to be written whole. `sparse`: few chunks
/// are; the file then has an index of those, a tree, else one with a place for each that there could be.
Handle create_growing(hid_t at, const char* name, hid_t type, std::vector<hsize_t> dims,
                      std::vector<hsize_t> chunk, Filters filters, bool sparse = false);

/// A dataset in one piece, whose rows are written later.
Handle create_fixed(hid_t at, const char* name, hid_t type, const std::vector<hsize_t>& dims);

/// Writes `count` rows of the first dimension from row `first` on, which are of type `type` in memory.
void write_rows(hid_t set, hsize_t first, hsize_t count, hid_t type, const void* data);

}  // namespace throng::recording::h5
