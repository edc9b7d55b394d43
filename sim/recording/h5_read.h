// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/recording/h5.h"

/// Reading a file that a stranger gave us. Every name is opened through a hard link, every type must be
/// exactly the expected one, and every size is held against that of the file before memory is taken; what a
/// recording never holds (external storage, virtual datasets, other filters) is refused. All throw h5::Error.
namespace throng::recording::h5 {

/// An open file.
struct File {
  Handle handle;
  std::string path;
  bool unfinished = false;  ///< its writer is at work, or died

  /// What its datasets may claim, in bytes: its size, and a little more where frames may be cut short.
  std::uint64_t room() const;
};

/// What a dataset may be. `whole`: all of it is in the file; `packed`: through shuffle and deflate, too;
/// `sparse`: most of it was never written. The last two are never read at once.
enum class Storage { whole, packed, sparse };

/// A dataset that passed the checks above.
struct Dataset {
  Handle set;
  std::vector<hsize_t> dims, chunk;  ///< chunk: empty where it is in one piece
};

bool exists(hid_t at, const char* name);
bool has_attribute(hid_t at, const char* name);
Handle open_group(hid_t at, const char* name);

template <class T>
T read_attribute(hid_t at, const char* name);
template <class T>
std::vector<T> read_attribute(hid_t at, const char* name, std::size_t count);
std::string read_attribute_text(hid_t at, const char* name);

inline constexpr std::nullopt_t kAny = std::nullopt;  ///< a dimension that is not given

/// Opens a dataset of T's type and of these dimensions; where one is not given, any will do.
template <class T>
Dataset open_dataset(const File& file, hid_t at, const char* name,
                     const std::vector<std::optional<hsize_t>>& dims, Storage storage = Storage::whole);

/// Which object of its file it is, by whatever links it was reached.
std::uint64_t address(const Dataset& dataset);

/// Reads row `row` of a packed dataset [rows, bodies, 2], a row a chunk or several, to `out`, which has its
/// size. HDF5's own inflate would take what memory a crafted chunk asks for. Throws where a chunk is not what
/// throng makes.
void read_packed_row(const Dataset& dataset, hsize_t row, std::span<std::uint32_t> out);

/// Reads `count` rows of the first dimension from row `first` on. Expects them to be there.
template <class T>
std::vector<T> read_rows(const Dataset& dataset, hsize_t first, hsize_t count);

/// Reads the first `rows` of a dataset, all where it isn't given.
template <class T>
std::vector<T> read_all(const Dataset& dataset, std::optional<hsize_t> rows = std::nullopt);

/// Reads row `row` of the first dimension to `out`, which holds `bytes`.
template <class T>
void read_row(const Dataset& dataset, hsize_t row, void* out, std::size_t bytes);

/// A whole static dataset in one call.
template <class T>
std::vector<T> read_array(const File& file, hid_t at, const char* name,
                          const std::vector<std::optional<hsize_t>>& dims = {std::nullopt}) {
  return read_all<T>(open_dataset<T>(file, at, name, dims));
}

/// Texts as written by write_text and write_texts: fixed length, UTF-8.
std::string read_text(const File& file, hid_t at, const char* name);
std::vector<std::string> read_texts(const File& file, hid_t at, const char* name);

}  // namespace throng::recording::h5
