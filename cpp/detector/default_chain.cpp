// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector/default_chain.hpp"

#include "error/error.hpp"
#include "instrument/detector.hpp"

#include <array>

namespace wfpsf {

Chain default_chain(const Instrument &instrument, double exposure_time) {
    const DetectorFigures figures = detector_figures(instrument);
    const auto constant = [&](const char *name) { return instrument.constant(name).value; };
    Chain chain;
    const auto add = [&](StepKind kind, auto... parameters) {
        chain.add(kind, std::array<double, sizeof...(parameters)>{parameters...});
    };
    const auto add_reciprocity = [&] {
        constexpr double base_flux = 1;
        add(StepKind::reciprocity_failure, constant("reciprocity_alpha"), exposure_time, base_flux);
    };
    if (figures.rounds_first) {
        add(StepKind::clip_negative);
        add(StepKind::poisson_noise);
        add(StepKind::quantisation, 1.0);
        add_reciprocity();
    } else {
        add(StepKind::poisson_noise);
        add_reciprocity();
        add(StepKind::quantisation, 1.0);
    }
    add(StepKind::dark_current, constant("dark_current"), exposure_time);
    if (!figures.persistence_fermi.empty()) {
        std::vector<double> parameters(figures.persistence_fermi.begin(),
                                       figures.persistence_fermi.end());
        parameters.push_back(exposure_time);
        chain.add(StepKind::persistence_fermi, parameters);
    }
    add(StepKind::nonlinearity, constant("nonlinearity_beta"));
    if (!instrument.ipc_kernel)
        fail(WFPSF_ERROR_ARGUMENT, "instrument: %s has no IPC kernel of its own", instrument.name);
    const IpcTaps &taps = *instrument.ipc_kernel;
    chain.add_ipc(IpcKernel::from_table({taps.data(), 3, 3, 1, 3}), Edge::zero);
    add(StepKind::read_noise, constant("read_noise"));
    add(StepKind::gain, constant("gain"));
    add(StepKind::quantisation, 1.0);
    return chain;
}

} // namespace wfpsf
