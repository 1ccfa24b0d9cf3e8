// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv.hpp"

#include <charconv>
#include <fstream>
#include <stdexcept>

namespace {

// Fields may stand in double quotes, inside which a quote is written twice.
std::vector<std::string> split(const std::string &line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[i++];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            fields.emplace_back();
        else if (line[i] != '\r')
            fields.back() += line[i];
    }
    return fields;
}

} // namespace

const std::string &Row::text(const std::string &column) const {
    const auto found = columns_->find(column);
    if (found == columns_->end())
        throw std::runtime_error("no column " + column);
    return fields_.at(found->second);
}

double Row::number(const std::string &column) const {
    const std::string &field = text(column);
    double value = 0;
    const char *end = field.data() + field.size();
    if (const auto result = std::from_chars(field.data(), end, value);
        result.ec != std::errc() || result.ptr != end)
        throw std::runtime_error(column + " = \"" + field + "\": not a number");
    return value;
}

int Row::integer(const std::string &column) const {
    return std::stoi(text(column));
}

Table::Table(const std::string &name) {
    std::ifstream file(reference_path(name));
    if (!file)
        throw std::runtime_error("cannot open " + reference_path(name));
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#')
            continue;
        std::vector<std::string> fields = split(line);
        if (columns_.empty()) {
            for (size_t i = 0; i < fields.size(); ++i)
                columns_[fields[i]] = i;
        } else {
            fields.resize(columns_.size());
            rows_.emplace_back(columns_, std::move(fields));
        }
    }
    if (rows_.empty())
        throw std::runtime_error(name + " holds no rows");
}

std::string reference_path(const std::string &name) {
    return WFPSF_REFERENCE_DIR "/" + name;
}
