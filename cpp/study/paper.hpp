// SPDX-License-Identifier: GPL-3.0-or-later
// What Kannawadi et al. 2016 print (Tables 1 to 4 and section 6), and what GalSim 2.8.4 gives when
// it is run the paper's way: all for wfirst-afta-c5, SCA 7, without IPC unless it says otherwise.
#pragma once

#include <string_view>

namespace wfpsf {

inline constexpr int paper_sca = 7;
inline constexpr std::string_view paper_instrument = "wfirst-afta-c5";

// Each NaN where nothing is printed. Quantities: "sigma" and "ee50_centroid" in mas, "e".
double paper_size(std::string_view band, bool struts, std::string_view quantity);

// Tables 3 and 4: quantities "sigma" (1/sigma d sigma/dp), "e1", "e2"; parameters "alpha",
// "alpha_prime", "alpha_plus".
double paper_sensitivity(std::string_view band, std::string_view quantity,
                         std::string_view parameter);

// Table 1, nm: blue, red, effective.
struct PaperBand {
    const char *band;
    double blue_nm, red_nm, effective_nm;
};
const PaperBand *paper_band(std::string_view band);

// The peer's "sigma" in mas: its published excess of 0.63, 0.88 and 0.98 % over the converged one
// with struts, and the paper's own without, which it meets to 5e-5.
double peer_size(std::string_view band, bool struts, std::string_view quantity);

// Section 6: all three errors 1e-4.
struct PaperRequirement {
    double error = 1e-4;
    double sigma = 5.75e-4, trace = 1.15e-3, e1 = 4.35e-4; // J129
    double allowed_trace = 9.3e-4, allowed_e = 4.7e-4;
};

// Why a printed value is more than 1 % off the converged one.
const char *reason_for_difference(std::string_view quantity, std::string_view parameter);

} // namespace wfpsf
