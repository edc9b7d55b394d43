// SPDX-License-Identifier: MIT
#include "sim/recording/row_log.h"

#include "sim/recording/h5_write.h"

namespace throng::recording {

template <class T>
RowLog RowLog::create(hid_t at, const char* name, hsize_t columns, hsize_t chunk) {
  RowLog log;
  std::vector<hsize_t> row{1}, chunks{chunk};
  if (columns > 1) row.push_back(columns), chunks.push_back(columns);
  log.set_ = h5::create_growing(at, name, h5::type<T>(), row, chunks, h5::Filters::none);
  log.type_ = h5::Handle(H5Dget_type(log.set_), H5Tclose, "cannot make a dataset");
  log.columns_ = columns;
  log.row_bytes_ = columns * sizeof(T);
  return log;
}

void RowLog::add(std::span<const std::byte> rows) {
  pending_.insert(pending_.end(), rows.begin(), rows.end());
}

void RowLog::commit() {
  const hsize_t rows = pending_.size() / row_bytes_;
  if (rows == 0) return;
  const int rank = columns_ > 1 ? 2 : 1;
  const hsize_t start[] = {committed_, 0}, count[] = {rows, columns_}, dims[] = {committed_ + rows, columns_};
  h5::check(H5Dset_extent(set_, dims), "cannot add a frame");
  const h5::Handle to(H5Dget_space(set_), H5Sclose, "cannot add a frame");
  const h5::Handle from(H5Screate_simple(rank, count, nullptr), H5Sclose, "cannot add a frame");
  h5::check(H5Sselect_hyperslab(to, H5S_SELECT_SET, start, nullptr, count, nullptr), "cannot add a frame");
  h5::check(H5Dwrite(set_, type_, from, to, H5P_DEFAULT, pending_.data()), "cannot write a frame");
  h5::check(H5Dflush(set_), "cannot write a frame");
  committed_ += rows;
  pending_.clear();
}

template RowLog RowLog::create<double>(hid_t, const char*, hsize_t, hsize_t);
template RowLog RowLog::create<std::int64_t>(hid_t, const char*, hsize_t, hsize_t);
template RowLog RowLog::create<std::uint32_t>(hid_t, const char*, hsize_t, hsize_t);
template RowLog RowLog::create<std::uint64_t>(hid_t, const char*, hsize_t, hsize_t);

}  // namespace throng::recording
