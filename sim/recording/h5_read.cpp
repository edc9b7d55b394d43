// SPDX-License-Identifier: MIT
#include "sim/recording/h5_read.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>

#include "sim/recording/packed.h"
#include "sim/recording/utf8.h"

namespace throng::recording::h5 {

namespace {

constexpr std::size_t kMaxAttribute = 64 * 1024, kMaxChunkBytes = 16 << 20;  // bytes
constexpr std::uint64_t kDensest = 1032;                      // what deflate can make of a byte
constexpr std::uint64_t kMostPacked = 2, kLeastPacked = 256;  // of what goes in, bytes
constexpr std::uint64_t kCutShort = 64'000'000;               // bytes, of frames on their way

[[noreturn]] void reject(const char* name, const char* why) {
  throw Error(std::string(name) + " " + why);
}

void expect_hard_link(hid_t at, const char* name) {
  H5L_info_t info;
  if (H5Lexists(at, name, H5P_DEFAULT) <= 0) reject(name, "is missing");
  check(H5Lget_info(at, name, &info, H5P_DEFAULT), name);
  if (info.type != H5L_TYPE_HARD) reject(name, "is a link to elsewhere");
}

/// The dataset's filters, in the order in which numbers went through them.
std::vector<H5Z_filter_t> filters(hid_t plist) {
  std::vector<H5Z_filter_t> found;
  const int count = check(H5Pget_nfilters(plist), "filters");
  for (int i = 0; i < count; ++i) {
    unsigned flags, config;
    std::size_t values = 0;
    found.push_back(H5Pget_filter2(plist, i, &flags, &values, nullptr, 0, nullptr, &config));
  }
  return found;
}

bool are_expected(const std::vector<H5Z_filter_t>& found, bool packed) {
  if (packed)
    return found == std::vector<H5Z_filter_t>{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
  return std::ranges::all_of(found, [](H5Z_filter_t filter) { return filter == H5Z_FILTER_FLETCHER32; });
}

/// `a` times `b`, or the largest number.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return a != 0 && b > std::numeric_limits<std::uint64_t>::max() / a
             ? std::numeric_limits<std::uint64_t>::max()
             : a * b;
}

std::vector<hsize_t> bounded_chunk(hid_t plist, const char* name, std::size_t element) {
  std::vector<hsize_t> chunk(H5S_MAX_RANK);
  chunk.resize(static_cast<std::size_t>(check(H5Pget_chunk(plist, H5S_MAX_RANK, chunk.data()), name)));
  std::uint64_t bytes = element;
  for (hsize_t size : chunk) bytes = times(bytes, size);
  if (bytes > kMaxChunkBytes) reject(name, "has chunks that are too large");
  return chunk;
}

void expect_own_storage(const File& file, Dataset& dataset, const char* name, std::size_t element,
                        Storage storage) {
  const Handle plist(H5Dget_create_plist(dataset.set), H5Pclose, name);
  const H5D_layout_t layout = H5Pget_layout(plist);
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) reject(name, "is stored in an unknown way");
  if (check(H5Pget_external_count(plist), name) != 0) reject(name, "is stored in another file");
  if (!are_expected(filters(plist), storage == Storage::packed))
    reject(name, "has a filter that throng never uses there");
  if (layout == H5D_CHUNKED) dataset.chunk = bounded_chunk(plist, name, element);

  std::uint64_t bytes = element;
  for (hsize_t dim : dataset.dims) bytes = times(bytes, dim);
  if (storage == Storage::sparse && !dataset.dims.empty()) bytes /= std::max<hsize_t>(1, dataset.dims[0]);
  if (bytes > times(file.room(), storage == Storage::packed ? kDensest : 1))
    reject(name, "claims more than the file can hold");
}

void expect_dims(const Dataset& dataset, const char* name, const std::vector<std::optional<hsize_t>>& dims) {
  if (dataset.dims.size() != dims.size()) reject(name, "has the wrong rank");
  for (std::size_t i = 0; i < dims.size(); ++i)
    if (dims[i] && *dims[i] != dataset.dims[i]) reject(name, "has the wrong size");
}

Dataset open_any(const File& file, hid_t at, const char* name, hid_t type, bool text,
                 Storage storage = Storage::whole) {
  expect_hard_link(at, name);
  Dataset result{{H5Dopen2(at, name, H5P_DEFAULT), H5Dclose, name}, {}, {}};
  const Handle found(H5Dget_type(result.set), H5Tclose, name),
      space(H5Dget_space(result.set), H5Sclose, name);
  const bool fits = text ? H5Tget_class(found) == H5T_STRING && H5Tis_variable_str(found) == 0
                         : check(H5Tequal(found, type), name) > 0;
  if (!fits) reject(name, "has the wrong type");
  const H5S_class_t kind = H5Sget_simple_extent_type(space);
  if (kind != H5S_SIMPLE && kind != H5S_SCALAR) reject(name, "has no extent");
  result.dims.resize(check(H5Sget_simple_extent_ndims(space), name));
  check(H5Sget_simple_extent_dims(space, result.dims.data(), nullptr), name);
  expect_own_storage(file, result, name, H5Tget_size(found), storage);
  return result;
}

/// H5Dread, whose errors name the dataset by its path.
void read(const Dataset& dataset, hid_t type, hid_t to, hid_t from, void* out) {
  try {
    check(H5Dread(dataset.set, type, to, from, H5P_DEFAULT, out), "cannot read");
  } catch (const Error& error) {
    char path[200] = "/?";
    H5Iget_name(dataset.set, path, sizeof path);
    throw Error(std::string(path + 1) + ": " + error.what());
  }
}

/// Reads the block of `dims` values at `start`. Expects room for them at `out`.
void read_block(const Dataset& dataset, hid_t type, const std::vector<hsize_t>& start,
                const std::vector<hsize_t>& dims, void* out) {
  const Handle from(H5Dget_space(dataset.set), H5Sclose, "cannot read");
  const Handle to(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose,
                  "cannot read");
  check(H5Sselect_hyperslab(from, H5S_SELECT_SET, start.data(), nullptr, dims.data(), nullptr),
        "cannot read");
  read(dataset, type, to, from, out);
}

std::string checked_text(std::string text, const char* name) {
  while (!text.empty() && text.back() == '\0') text.pop_back();
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = utf8_character(rest);
    if (length == 0 || rest[0] == '\0') reject(name, "is no UTF-8 text");
    rest.remove_prefix(length);
  }
  return text;
}

Handle open_attribute(hid_t at, const char* name) {
  if (check(H5Aexists(at, name), name) == 0) reject(name, "is missing");
  Handle attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose, name);
  if (H5Aget_storage_size(attribute) > kMaxAttribute) reject(name, "is too large");
  return attribute;
}

}  // namespace

std::uint64_t File::room() const {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size + (unfinished ? kCutShort : 0);
}

bool has_attribute(hid_t at, const char* name) {
  return check(H5Aexists(at, name), name) > 0;
}

bool exists(hid_t at, const char* name) {
  return check(H5Lexists(at, name, H5P_DEFAULT), name) > 0;
}

Handle open_group(hid_t at, const char* name) {
  expect_hard_link(at, name);
  return {H5Gopen2(at, name, H5P_DEFAULT), H5Gclose, name};
}

template <class T>
std::vector<T> read_attribute(hid_t at, const char* name, std::size_t count) {
  const Handle attribute = open_attribute(at, name);
  const Handle found(H5Aget_type(attribute), H5Tclose, name), space(H5Aget_space(attribute), H5Sclose, name);
  if (check(H5Tequal(found, type<T>()), name) == 0) reject(name, "has the wrong type");
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(count)) reject(name, "has the wrong size");
  std::vector<T> values(count);
  check(H5Aread(attribute, type<T>(), values.data()), name);
  return values;
}

template <class T>
T read_attribute(hid_t at, const char* name) {
  return read_attribute<T>(at, name, 1)[0];
}

std::string read_attribute_text(hid_t at, const char* name) {
  const Handle attribute = open_attribute(at, name);
  const Handle found(H5Aget_type(attribute), H5Tclose, name), space(H5Aget_space(attribute), H5Sclose, name);
  if (H5Tget_class(found) != H5T_STRING || H5Tis_variable_str(found) != 0) reject(name, "has the wrong type");
  if (H5Sget_simple_extent_npoints(space) != 1) reject(name, "has the wrong size");
  std::string text(H5Tget_size(found), '\0');
  check(H5Aread(attribute, found, text.data()), name);
  return checked_text(std::move(text), name);
}

template <class T>
Dataset open_dataset(const File& file, hid_t at, const char* name,
                     const std::vector<std::optional<hsize_t>>& dims, Storage storage) {
  Dataset result = open_any(file, at, name, type<T>(), false, storage);
  expect_dims(result, name, dims);
  return result;
}

std::uint64_t address(const Dataset& dataset) {
  H5O_info_t info;
  check(H5Oget_info2(dataset.set, &info, H5O_INFO_BASIC), "cannot read");
  return info.addr;
}

template <class T>
std::vector<T> read_all(const Dataset& dataset, std::optional<hsize_t> rows) {
  std::vector<hsize_t> dims = dataset.dims;
  if (rows && !dims.empty()) dims[0] = std::min(*rows, dims[0]);
  std::uint64_t count = 1;
  for (hsize_t dim : dims) count *= dim;
  std::vector<T> values(count);
  if (dims.empty())
    read(dataset, type<T>(), H5S_ALL, H5S_ALL, values.data());
  else if (count > 0)
    read_block(dataset, type<T>(), std::vector<hsize_t>(dims.size(), 0), dims, values.data());
  return values;
}

template <class T>
void read_row(const Dataset& dataset, hsize_t row, void* out, std::size_t bytes) {
  std::vector<hsize_t> dims = dataset.dims, start(dims.size(), 0);
  start[0] = row;
  dims[0] = 1;
  std::uint64_t expected = sizeof(T);
  for (hsize_t dim : dims) expected *= dim;
  if (expected != bytes) throw Error("a frame has the wrong size");
  if (bytes > 0) read_block(dataset, type<T>(), start, dims, out);
}

template <class T>
std::vector<T> read_rows(const Dataset& dataset, hsize_t first, hsize_t count) {
  std::vector<hsize_t> dims = dataset.dims, start(dims.size(), 0);
  start[0] = first;
  dims[0] = count;
  std::uint64_t numbers = 1;
  for (hsize_t dim : dims) numbers *= dim;
  std::vector<T> values(numbers);
  if (numbers > 0) read_block(dataset, type<T>(), start, dims, values.data());
  return values;
}

void read_packed_row(const Dataset& dataset, hsize_t row, std::span<std::uint32_t> out) {
  const hsize_t columns = dataset.dims[2], bodies = dataset.chunk[1];
  std::vector<std::uint32_t> numbers(bodies * columns);
  std::vector<std::byte> bytes;
  for (std::size_t at = 0; at < out.size(); at += numbers.size()) {
    const hsize_t place[] = {row, at / columns, 0};
    hsize_t size = 0;
    check(H5Dget_chunk_storage_size(dataset.set, place, &size), "cannot read");
    if (size == 0 || size > kMostPacked * (numbers.size() * sizeof(std::uint32_t) + kLeastPacked))
      throw Error("a chunk has a size that throng never makes");
    bytes.resize(size);
    std::uint32_t skipped = 0;
    check(H5Dread_chunk(dataset.set, H5P_DEFAULT, place, &skipped, bytes.data()), "cannot read");
    if (skipped != 0 || !unpack(bytes, numbers)) throw Error("a chunk cannot be unpacked");
    std::copy_n(numbers.begin(), std::min(numbers.size(), out.size() - at), out.begin() + at);
  }
}

std::string read_text(const File& file, hid_t at, const char* name) {
  const Dataset dataset = open_any(file, at, name, -1, true);
  expect_dims(dataset, name, {});
  const Handle found(H5Dget_type(dataset.set), H5Tclose, name);
  std::string text(H5Tget_size(found), '\0');
  read(dataset, found, H5S_ALL, H5S_ALL, text.data());
  return checked_text(std::move(text), name);
}

std::vector<std::string> read_texts(const File& file, hid_t at, const char* name) {
  const Dataset dataset = open_any(file, at, name, -1, true);
  expect_dims(dataset, name, {std::nullopt});
  const Handle found(H5Dget_type(dataset.set), H5Tclose, name);
  const std::size_t length = H5Tget_size(found);
  std::string block(length * dataset.dims[0], '\0');
  if (!block.empty()) read(dataset, found, H5S_ALL, H5S_ALL, block.data());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < dataset.dims[0]; ++i)
    texts.push_back(checked_text(block.substr(i * length, length), name));
  return texts;
}

#define THRONG_READABLE(T)                                                               \
  template T read_attribute(hid_t, const char*);                                         \
  template std::vector<T> read_attribute(hid_t, const char*, std::size_t);               \
  template Dataset open_dataset<T>(const File&, hid_t, const char*,                      \
                                   const std::vector<std::optional<hsize_t>>&, Storage); \
  template std::vector<T> read_rows(const Dataset&, hsize_t, hsize_t);                   \
  template std::vector<T> read_all(const Dataset&, std::optional<hsize_t>);              \
  template void read_row<T>(const Dataset&, hsize_t, void*, std::size_t);
THRONG_READABLE(double)
THRONG_READABLE(float)
THRONG_READABLE(std::uint8_t)
THRONG_READABLE(std::int32_t)
THRONG_READABLE(std::uint32_t)
THRONG_READABLE(std::int64_t)
THRONG_READABLE(std::uint64_t)
#undef THRONG_READABLE

}  // namespace throng::recording::h5
