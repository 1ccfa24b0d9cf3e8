// SPDX-License-Identifier: GPL-3.0-or-later
// The images of the reference's moments, by name.
#pragma once

#include "csv.hpp"
#include "handles.hpp"

#include <map>

inline std::map<std::string, Pixels> read_images() {
    std::map<std::string, Pixels> images;
    for (const Row &row : Table("moments/images.csv")) {
        const std::string &id = row.text("id");
        images.emplace(id, read_fits("moments/images_" + row.text("kind") + ".fits", id));
    }
    return images;
}
