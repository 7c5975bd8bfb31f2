// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/bag_database.hpp"

#include <sqlite3.h>

#include <cctype>
#include <string_view>
#include <system_error>

#include "sslam/io/bags/messages.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;

// The file as SQLite's URI, so that no name means something else.
std::string uri_of(const fs::path& path, const char* options) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '_' || c == '-')
      uri += c;
    else
      uri.append({'%', kHex[byte >> 4U], kHex[byte & 15U]});
  }
  return uri + options;
}

fs::path write_ahead_log_of(const fs::path& path) {
  return path.string() + "-wal";
}

std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : size;
}

class SqliteBag final : public io::BagDatabase {
 public:
  explicit SqliteBag(const fs::path& path) {
    const std::uint64_t log = size_of(write_ahead_log_of(path));
    left_ = size_of(path) + log;
    // Where nobody writes, nothing is locked, and no file made beside. What stands in a log needs both.
    const std::string uri = uri_of(path, log == 0 ? "?immutable=1" : "?mode=ro");
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) throw Error("cannot be opened: " + std::string(sqlite3_errstr(code)));
    // A file may hold more than data: views, triggers and functions that run when it is read.
    for (const int off :
         {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER})
      sqlite3_db_config(opened, off, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(io::kLargestChunk));
    demand_table("topics", "id, name, type, serialization_format");
    demand_table("messages", "id, topic_id, timestamp, data");
  }

  std::vector<std::pair<std::int64_t, io::BagChannel>> topics() override {
    std::vector<std::pair<std::int64_t, io::BagChannel>> found;
    const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
    while (step(rows)) {
      spend(text(rows, 1).size() + text(rows, 2).size());
      found.emplace_back(
          sqlite3_column_int64(rows.get(), 0),
          io::BagChannel{std::string(text(rows, 1)), std::string(text(rows, 2)), std::string(text(rows, 3))});
    }
    return found;
  }

  std::optional<io::DatabaseMessage> next() override {
    if (!all_) all_ = prepare("SELECT rowid, topic_id, timestamp, data FROM messages");
    if (!step(all_)) return {};
    const auto number = [&](int column) { return sqlite3_column_int64(all_.get(), column); };
    const std::string_view data = text(all_, 3);
    spend(data.size());
    return io::DatabaseMessage{number(0), number(1), number(2), data};
  }

  bool read(std::int64_t id, std::string& out) override {
    if (!one_) one_ = prepare("SELECT data FROM messages WHERE rowid = ?");
    sqlite3_reset(one_.get());
    sqlite3_bind_int64(one_.get(), 1, id);
    const bool found = step(one_);
    if (found) out = text(one_, 0);
    sqlite3_reset(one_.get());
    return found;
  }

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept { sqlite3_close_v2(database); }
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  [[noreturn]] void fail() const {
    throw Error(sqlite3_errcode(database_.get()) == SQLITE_CORRUPT
                    ? "is damaged or cut off; `sqlite3 OLD .recover | sqlite3 NEW` saves what it can"
                    : "SQLite says: " + io::shown_word(sqlite3_errmsg(database_.get())));
  }

  [[nodiscard]] Statement prepare(const char* query) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), query, -1, &statement, nullptr) != SQLITE_OK) fail();
    return Statement(statement);
  }

  // False: there are no more rows.
  bool step(const Statement& statement) const {
    const int code = sqlite3_step(statement.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) fail();
    return code == SQLITE_ROW;
  }

  // Of the row that the statement stands on, text or bytes.
  static std::string_view text(const Statement& statement, int column) {
    const void* const bytes = sqlite3_column_blob(statement.get(), column);
    const int size = sqlite3_column_bytes(statement.get(), column);
    return bytes == nullptr
               ? std::string_view()
               : std::string_view(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
  }

  // Pages that lead to each other in a circle would never end: all rows together are no more than the file.
  void spend(std::uint64_t bytes) {
    if (bytes >= left_) throw Error("holds more than its size allows: it is damaged");
    left_ -= bytes + 1;
  }

  // A plain table, with nothing that is computed: not a view nor a module's.
  void demand_table(const std::string& name, const std::string& columns) const {
    const Statement row =
        prepare(("SELECT (SELECT count(*) FROM sqlite_schema WHERE name = '" + name +
                 "' AND type = 'table' AND rootpage > 0), (SELECT count(*) FROM pragma_table_xinfo('" + name +
                 "') WHERE hidden <> 0)")
                    .c_str());
    if (!step(row)) fail();
    const bool plain = sqlite3_column_int(row.get(), 0) == 1 && sqlite3_column_int(row.get(), 1) == 0;
    sqlite3_stmt* statement = nullptr;
    const bool known =
        plain && sqlite3_prepare_v2(database_.get(), ("SELECT rowid, " + columns + " FROM " + name).c_str(),
                                    -1, &statement, nullptr) == SQLITE_OK;
    const Statement closed(statement);
    if (!known)
      throw Error("is an SQLite file, but no bag of ROS 2: it has no table " + name + " with " + columns);
  }

  std::unique_ptr<sqlite3, Close> database_;
  Statement all_, one_;
  std::uint64_t left_ = 0;  // bytes that may still come
};

}  // namespace

std::unique_ptr<io::BagDatabase> open_bag_database(const fs::path& path) {
  return std::make_unique<SqliteBag>(path);
}

}  // namespace sslam::cli
