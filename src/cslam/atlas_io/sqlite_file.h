// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace cslam {

// CRC-32 over a sequence of values: equal only if types, values and order are.
class Checksum {
 public:
  void AddInt(std::int64_t value);
  void AddDouble(double value);
  void AddBytes(std::string_view bytes);
  void AddNull();

  std::uint32_t value() const { return crc_; }

 private:
  void Add(char tag, const void* data, std::size_t size);

  std::uint32_t crc_ = 0;
};

// One SQLite file. Every failure throws Error with what SQLite says, without the file's name.
class SqliteFile {
 public:
  // An existing empty file, written by this object alone and without a journal: whoever opens it
  // gives it its name only when it is complete.
  static SqliteFile OpenForWriting(const std::filesystem::path& path);

  // Reads what is there, takes no lock and creates no file.
  static SqliteFile OpenForReading(const std::filesystem::path& path);

  void Execute(const std::string& sql);

  // Reports what was kept back until the end.
  void Close();

  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Closer {
    void operator()(sqlite3* handle) const;
  };
  SqliteFile(const std::filesystem::path& path, int flags, const char* vfs, bool is_uri);

  std::unique_ptr<sqlite3, Closer> handle_;
};

struct StatementCloser {
  void operator()(sqlite3_stmt* statement) const;
};

// Appends rows to a table, value by value in the order of its columns. Bytes must stay as they
// are until EndRow().
class TableWriter {
 public:
  TableWriter(const SqliteFile& file, std::string_view table, int num_columns);

  void Int(std::int64_t value);
  void Double(double value);  // kept bit by bit; must not be NaN
  void Text(std::string_view text);
  void Blob(std::string_view bytes);
  void BlobCopy(std::string_view bytes);  // need not stay
  void Null();
  void EndRow();

  std::int64_t num_rows() const { return num_rows_; }
  std::uint32_t crc() const { return checksum_.value(); }

 private:
  void Check(int result) const;

  sqlite3* database_ = nullptr;
  std::unique_ptr<sqlite3_stmt, StatementCloser> statement_;
  int num_columns_ = 0;
  int column_ = 0;
  std::int64_t num_rows_ = 0;
  Checksum checksum_;
};

// Reads a table row by row, value by value in the order of its columns. A value of another type
// throws Error. Texts and blobs live until the next call of NextRow().
class TableReader {
 public:
  TableReader(const SqliteFile& file, std::string_view table, std::string_view columns,
              std::string_view order_by);

  bool NextRow();
  bool IsNull() const;
  void SkipNull();
  std::int64_t Int();
  double Double();
  std::string_view Text();
  std::string_view Blob();

  std::int64_t num_rows() const { return num_rows_; }
  std::uint32_t crc() const { return checksum_.value(); }

 private:
  std::string_view Bytes(int type);
  void ExpectType(int type) const;

  sqlite3* database_ = nullptr;
  std::string table_;
  std::unique_ptr<sqlite3_stmt, StatementCloser> statement_;
  int column_ = 0;
  std::int64_t num_rows_ = 0;
  Checksum checksum_;
};

}  // namespace cslam
