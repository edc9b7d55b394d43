// SPDX-License-Identifier: MIT
#include "sim/recording/h5_write.h"

#include <algorithm>
#include <iterator>

#include "sim/recording/fletcher32.h"
#include "sim/recording/layout.h"

namespace throng::recording::h5 {

namespace {

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot make a text type");
  check(H5Tset_size(type, std::max<std::size_t>(1, length)), "cannot size a text");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "cannot pad a text");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "cannot make a text UTF-8");
  return type;
}

Handle space(std::span<const hsize_t> dims) {
  const hid_t id = dims.empty() ? H5Screate(H5S_SCALAR)
                                : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
  return {id, H5Sclose, "cannot make a dataspace"};
}

void write_attribute(hid_t at, const char* name, hid_t type, std::span<const hsize_t> dims,
                     const void* data) {
  const Handle where = space(dims);
  Handle attribute(H5Acreate2(at, name, type, where, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                   "cannot make an attribute");
  check(H5Awrite(attribute, type, data), "cannot write an attribute");
  attribute.close("cannot write an attribute");
}

/// All texts in one block, each padded with zeros to the longest.
std::string padded(const std::vector<std::string>& texts, std::size_t length) {
  std::string block;
  for (const std::string& text : texts) block.append(text).append(length - text.size(), '\0');
  return block;
}

std::size_t longest(const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  return length;
}

/// Of a dataset without times of its own: equal values make equal files.
Handle plain_layout() {
  Handle plist(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "cannot make a property list");
  check(H5Pset_obj_track_times(plist, false), "cannot leave out times");
  return plist;
}

/// Chunks of so many whole rows, with fletcher32; nothing of the sort for an empty dataset.
Handle static_layout(std::span<const hsize_t> dims, hsize_t rows) {
  Handle plist = plain_layout();
  if (dims[0] == 0) return plist;
  std::vector<hsize_t> chunk(dims.begin(), dims.end());
  chunk[0] = rows;
  check(H5Pset_chunk(plist, static_cast<int>(chunk.size()), chunk.data()), "cannot set chunks");
  check(H5Pset_fletcher32(plist), "cannot set fletcher32");
  return plist;
}

/// Puts chunks of `chunk_bytes`, the last padded with zeros, behind HDF5's own pipeline, which copies each of
/// them three times.
void write_chunks(hid_t set, std::span<const std::byte> data, std::size_t chunk_bytes, hsize_t rows) {
  std::vector<std::byte> chunk;
  chunk.reserve(chunk_bytes + sizeof(std::uint32_t));
  hsize_t place[] = {0, 0};
  for (std::size_t at = 0; at < data.size(); at += chunk_bytes, place[0] += rows) {
    const auto part = data.subspan(at, std::min(chunk_bytes, data.size() - at));
    chunk.assign(part.begin(), part.end());
    chunk.resize(chunk_bytes);
    const std::uint32_t sum = fletcher32(chunk);
    std::ranges::copy(std::as_bytes(std::span(&sum, 1)), std::back_inserter(chunk));
    check(H5Dwrite_chunk(set, H5P_DEFAULT, 0, place, chunk.size(), chunk.data()), "cannot write a dataset");
  }
}

void write_static(hid_t at, const char* name, hid_t type, std::span<const hsize_t> dims,
                  std::size_t row_bytes, const void* data) {
  const hsize_t rows = std::min<hsize_t>(dims[0], std::max<hsize_t>(1, kMaxChunk / row_bytes));
  const Handle where = space(dims), layout = static_layout(dims, rows);
  Handle set(H5Dcreate2(at, name, type, where, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose,
             "cannot make a dataset");
  if (dims[0] > 0)
    write_chunks(set, {static_cast<const std::byte*>(data), dims[0] * row_bytes}, rows * row_bytes, rows);
  set.close("cannot write a dataset");  // what HDF5 held back is written here, and may fail here
}

}  // namespace

Handle create_file(const std::string& path) {
  prepare();
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "cannot make the file"};
}

Handle create_group(hid_t at, const char* name) {
  return {H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "cannot make a group"};
}

Handle create_groups(hid_t at, const char* path) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "cannot make a property list");
  check(H5Pset_create_intermediate_group(links, 1), "cannot make a group");
  return {H5Gcreate2(at, path, links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "cannot make a group"};
}

void write_attribute(hid_t at, const char* name, std::string_view text) {
  const Handle type = text_type(text.size());
  const std::string data = text.empty() ? std::string(1, '\0') : std::string(text);
  write_attribute(at, name, type, {}, data.data());
}

void write_attribute(hid_t at, const char* name, const std::vector<std::string>& texts) {
  const Handle type = text_type(longest(texts));
  const hsize_t dims[] = {texts.size()};
  write_attribute(at, name, type, dims, padded(texts, longest(texts)).data());
}

template <class T>
void write_attribute(hid_t at, const char* name, T value) {
  write_attribute(at, name, type<T>(), {}, &value);
}

template <class T>
void write_attribute(hid_t at, const char* name, std::span<const T> values) {
  const hsize_t dims[] = {values.size()};
  write_attribute(at, name, type<T>(), dims, values.data());
}

void write_text(hid_t at, const char* name, std::string_view text) {
  const Handle type = text_type(text.size()), where = space({}), layout = plain_layout();
  Handle set(H5Dcreate2(at, name, type, where, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose,
             "cannot make a text");
  const std::string data = text.empty() ? std::string(1, '\0') : std::string(text);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()), "cannot write a text");
  set.close("cannot write a text");
}

void write_texts(hid_t at, const char* name, const std::vector<std::string>& texts) {
  const std::size_t length = longest(texts);
  const Handle type = text_type(length);
  const hsize_t dims[] = {texts.size()};
  write_static(at, name, type, dims, length, padded(texts, length).data());
}

template <class T>
void write_array(hid_t at, const char* name, std::span<const T> values, hsize_t columns) {
  const hsize_t dims[] = {values.size() / columns, columns};
  write_static(at, name, type<T>(), std::span(dims, columns > 1 ? 2 : 1), columns * sizeof(T), values.data());
}

Handle create_growing(hid_t at, const char* name, hid_t type, std::vector<hsize_t> dims,
                      std::vector<hsize_t> chunk, Filters filters, bool sparse) {
  std::vector<hsize_t> limit = dims;
  dims[0] = 0;
  limit[0] = H5S_UNLIMITED;
  if (sparse) limit[1] = H5S_UNLIMITED;  // never used: HDF5 takes the tree where two dimensions may grow
  const int rank = static_cast<int>(dims.size());
  const Handle where(H5Screate_simple(rank, dims.data(), limit.data()), H5Sclose, "cannot make a dataspace");
  const Handle layout = plain_layout();
  check(H5Pset_chunk(layout, rank, chunk.data()), "cannot set chunks");
  const std::int32_t nothing = 0;  // said, not left to HDF5: to H5MD it is what isn't there
  check(H5Pset_fill_value(layout, H5T_NATIVE_INT32, &nothing), "cannot set the fill value");
  if (filters == Filters::packed) {
    check(H5Pset_shuffle(layout), "cannot set shuffle");
    check(H5Pset_deflate(layout, 1), "cannot set deflate");
  }
  if (filters != Filters::none) check(H5Pset_fletcher32(layout), "cannot set fletcher32");
  // No chunk cache for frames: each is written whole and never again.
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose, "cannot make a property list");
  if (filters != Filters::none) check(H5Pset_chunk_cache(access, 0, 0, 1.0), "cannot set the chunk cache");
  return {H5Dcreate2(at, name, type, where, H5P_DEFAULT, layout, access), H5Dclose, "cannot make a dataset"};
}

Handle create_fixed(hid_t at, const char* name, hid_t type, const std::vector<hsize_t>& dims) {
  const Handle where = space(dims), layout = plain_layout();
  return {H5Dcreate2(at, name, type, where, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose,
          "cannot make a dataset"};
}

void write_rows(hid_t set, hsize_t first, hsize_t count, hid_t type, const void* data) {
  const Handle to(H5Dget_space(set), H5Sclose, "cannot write rows");
  std::vector<hsize_t> size(check(H5Sget_simple_extent_ndims(to), "cannot write rows")), start(size.size());
  check(H5Sget_simple_extent_dims(to, size.data(), nullptr), "cannot write rows");
  start[0] = first;
  size[0] = count;
  const Handle from = space(size);
  check(H5Sselect_hyperslab(to, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr),
        "cannot write rows");
  check(H5Dwrite(set, type, from, to, H5P_DEFAULT, data), "cannot write rows");
}

template void write_attribute(hid_t, const char*, double);
template void write_attribute(hid_t, const char*, std::int64_t);
template void write_attribute(hid_t, const char*, std::uint64_t);
template void write_attribute(hid_t, const char*, std::span<const std::int32_t>);
template void write_attribute(hid_t, const char*, std::span<const double>);
template void write_array(hid_t, const char*, std::span<const double>, hsize_t);
template void write_array(hid_t, const char*, std::span<const std::uint8_t>, hsize_t);
template void write_array(hid_t, const char*, std::span<const std::uint32_t>, hsize_t);
template void write_array(hid_t, const char*, std::span<const std::int64_t>, hsize_t);
template void write_array(hid_t, const char*, std::span<const std::uint64_t>, hsize_t);

}  // namespace throng::recording::h5
