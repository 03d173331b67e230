// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/atlas_io/sqlite_file.h"

#include "cslam/util/check.h"

#include <sqlite3.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <system_error>

namespace cslam {
namespace {

static_assert(std::endian::native == std::endian::little, "values are checked as they lie");

[[noreturn]] void Fail(sqlite3* database) {
  const int error_number = sqlite3_system_errno(database);
  const bool has_reason = error_number != 0 && sqlite3_errcode(database) != SQLITE_CORRUPT;
  const std::string reason =
      has_reason ? fmt::format(" ({})", std::generic_category().message(error_number)) : "";
  throw Error("{}{}", sqlite3_errmsg(database), reason);
}

using OwnedStatement = std::unique_ptr<sqlite3_stmt, StatementCloser>;

OwnedStatement Prepare(sqlite3* database, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr);
  OwnedStatement owned(statement);
  if (result != SQLITE_OK) Fail(database);
  return owned;
}

// Blanks, '?', '#' and '%' mean something in a URI.
std::string UriOf(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_';
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri + "?immutable=1";
}

}  // namespace

void Checksum::Add(char tag, const void* data, std::size_t size) {
  uLong crc = crc32_z(crc_, reinterpret_cast<const Bytef*>(&tag), 1);
  crc = crc32_z(crc, static_cast<const Bytef*>(data), size);
  crc_ = static_cast<std::uint32_t>(crc);
}

void Checksum::AddInt(std::int64_t value) {
  Add('i', &value, sizeof(value));
}

void Checksum::AddDouble(double value) {
  Add('d', &value, sizeof(value));
}

void Checksum::AddBytes(std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  Add('b', &size, sizeof(size));
  if (!bytes.empty()) Add('.', bytes.data(), bytes.size());
}

void Checksum::AddNull() {
  Add('n', "", 1);
}

void SqliteFile::Closer::operator()(sqlite3* handle) const {
  sqlite3_close_v2(handle);
}

void StatementCloser::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteFile::SqliteFile(const std::filesystem::path& path, int flags, const char* vfs, bool is_uri) {
  const std::string name = is_uri ? UriOf(path) : path.string();
  sqlite3* handle = nullptr;
  const int result = sqlite3_open_v2(name.c_str(), &handle, flags, vfs);
  handle_.reset(handle);
  if (handle == nullptr) throw Error("out of memory");
  if (result != SQLITE_OK) Fail(handle);
}

SqliteFile SqliteFile::OpenForWriting(const std::filesystem::path& path) {
  SqliteFile file(std::filesystem::absolute(path), SQLITE_OPEN_READWRITE, "unix-none", false);
  file.Execute("PRAGMA page_size = 16384");  // most of the file is blobs of 10 to 40 kB
  file.Execute("PRAGMA journal_mode = OFF");
  file.Execute("PRAGMA synchronous = OFF");  // the caller does it, once
  return file;
}

SqliteFile SqliteFile::OpenForReading(const std::filesystem::path& path) {
  SqliteFile file(path, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr, true);
  // A damaged file cannot ask for more than it holds, and nothing in it is run.
  const std::uintmax_t size = std::filesystem::file_size(path);
  constexpr std::uintmax_t kMaxBytes = 1'000'000'000;
  sqlite3_limit(file.handle(), SQLITE_LIMIT_LENGTH, static_cast<int>(std::min(size, kMaxBytes)));
  sqlite3_db_config(file.handle(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(file.handle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  file.Execute("PRAGMA cell_size_check = ON");
  return file;
}

void SqliteFile::Execute(const std::string& sql) {
  if (sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail(handle());
}

void SqliteFile::Close() {
  if (sqlite3_close(handle()) != SQLITE_OK) Fail(handle());
  handle_.release();
}

TableWriter::TableWriter(const SqliteFile& file, std::string_view table, int num_columns)
    : database_(file.handle()), num_columns_(num_columns) {
  std::string marks = "?";
  for (int i = 1; i < num_columns; ++i)
    marks += ", ?";
  statement_ = Prepare(database_, fmt::format("INSERT INTO {} VALUES ({})", table, marks));
}

void TableWriter::Check(int result) const {
  if (result != SQLITE_OK) Fail(database_);
}

void TableWriter::Int(std::int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), ++column_, value));
  checksum_.AddInt(value);
}

void TableWriter::Double(double value) {
  CSLAM_CHECK(value == value);
  Check(sqlite3_bind_double(statement_.get(), ++column_, value));
  checksum_.AddDouble(value);
}

void TableWriter::Text(std::string_view text) {
  Check(sqlite3_bind_text64(statement_.get(), ++column_, text.data(), text.size(), SQLITE_STATIC,
                            SQLITE_UTF8));
  checksum_.AddBytes(text);
}

void TableWriter::Blob(std::string_view bytes) {
  const char* const data = bytes.empty() ? "" : bytes.data();  // a null pointer would mean NULL
  Check(sqlite3_bind_blob64(statement_.get(), ++column_, data, bytes.size(), SQLITE_STATIC));
  checksum_.AddBytes(bytes);
}

void TableWriter::BlobCopy(std::string_view bytes) {
  const char* const data = bytes.empty() ? "" : bytes.data();
  Check(sqlite3_bind_blob64(statement_.get(), ++column_, data, bytes.size(), SQLITE_TRANSIENT));
  checksum_.AddBytes(bytes);
}

void TableWriter::Null() {
  Check(sqlite3_bind_null(statement_.get(), ++column_));
  checksum_.AddNull();
}

void TableWriter::EndRow() {
  CSLAM_CHECK(column_ == num_columns_, "{} of {} columns", column_, num_columns_);
  if (sqlite3_step(statement_.get()) != SQLITE_DONE) Fail(database_);
  Check(sqlite3_reset(statement_.get()));
  column_ = 0;
  ++num_rows_;
}

TableReader::TableReader(const SqliteFile& file, std::string_view table, std::string_view columns,
                         std::string_view order_by)
    : database_(file.handle()),
      table_(table),
      statement_(Prepare(database_,
                         fmt::format("SELECT {} FROM {} ORDER BY {}", columns, table, order_by))) {}

bool TableReader::NextRow() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_DONE) return false;
  if (result != SQLITE_ROW) Fail(database_);
  column_ = 0;
  ++num_rows_;
  return true;
}

bool TableReader::IsNull() const {
  return sqlite3_column_type(statement_.get(), column_) == SQLITE_NULL;
}

void TableReader::SkipNull() {
  ExpectType(SQLITE_NULL);
  ++column_;
  checksum_.AddNull();
}

void TableReader::ExpectType(int type) const {
  if (sqlite3_column_type(statement_.get(), column_) != type) {
    throw Error("column '{}' of table '{}' has a value of another type",
                sqlite3_column_name(statement_.get(), column_), table_);
  }
}

std::int64_t TableReader::Int() {
  ExpectType(SQLITE_INTEGER);
  const std::int64_t value = sqlite3_column_int64(statement_.get(), column_++);
  checksum_.AddInt(value);
  return value;
}

double TableReader::Double() {
  ExpectType(SQLITE_FLOAT);
  const double value = sqlite3_column_double(statement_.get(), column_++);
  checksum_.AddDouble(value);
  return value;
}

std::string_view TableReader::Bytes(int type) {
  ExpectType(type);
  const void* const data = sqlite3_column_blob(statement_.get(), column_);
  const int size = sqlite3_column_bytes(statement_.get(), column_++);
  if (size > 0 && data == nullptr) Fail(database_);
  const std::string_view bytes(static_cast<const char*>(data), static_cast<std::size_t>(size));
  checksum_.AddBytes(bytes);
  return bytes;
}

std::string_view TableReader::Text() {
  return Bytes(SQLITE_TEXT);
}

std::string_view TableReader::Blob() {
  return Bytes(SQLITE_BLOB);
}

}  // namespace cslam
