// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/table.hpp"

#include <cmath>
#include <cstdio>

namespace wfpsf {

namespace {

std::string text_of(double number) {
    if (std::isnan(number))
        return {};
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

std::string text_of(const std::string &words) {
    if (words.find_first_of(",\"\n") == std::string::npos)
        return words;
    std::string quoted(1, '"');
    for (const char c : words)
        quoted.append(c == '"' ? 2 : 1, c);
    quoted.push_back('"');
    return quoted;
}

} // namespace

std::string as_csv(const StudyTable &table) {
    std::string text;
    const auto add_line = [&text](const auto &cells, const auto &written) {
        for (const auto &cell : cells) {
            text += written(cell);
            text += ',';
        }
        text.back() = '\n';
    };
    add_line(table.columns, [](const std::string &name) { return text_of(name); });
    for (const std::vector<StudyCell> &row : table.rows)
        add_line(row, [](const StudyCell &cell) {
            return std::visit([](const auto &value) { return text_of(value); }, cell);
        });
    return text;
}

} // namespace wfpsf
