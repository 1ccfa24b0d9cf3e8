// SPDX-License-Identifier: GPL-3.0-or-later
// The reference's tables: lines starting with '#' are comments, then come the column names.
#pragma once

#include <map>
#include <string>
#include <vector>

// One line of a table.
class Row {
  public:
    Row(const std::map<std::string, size_t> &columns, std::vector<std::string> fields)
        : columns_(&columns), fields_(std::move(fields)) {}

    // Throw where there is no such column, or no number in it.
    const std::string &text(const std::string &column) const;
    double number(const std::string &column) const;
    int integer(const std::string &column) const;
    bool has(const std::string &column) const { return !text(column).empty(); }

  private:
    const std::map<std::string, size_t> *columns_;
    std::vector<std::string> fields_;
};

class Table {
  public:
    // `name` from the reference's folder on, such as "moments/moments.csv".
    explicit Table(const std::string &name);
    Table(const Table &) = delete; // rows point to their table
    Table &operator=(const Table &) = delete;

    auto begin() const { return rows_.begin(); }
    auto end() const { return rows_.end(); }

  private:
    std::map<std::string, size_t> columns_;
    std::vector<Row> rows_;
};

// Path of a file of the reference.
std::string reference_path(const std::string &name);
