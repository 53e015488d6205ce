// MeasureLoad.h - what `measure` prints in addition to each channel's values: their uncertainty and quality, and the
// load computed from voltage and current.
//
// Keys: channels[].uncertainty {coverage_factor, amplitude, width_s, interval_s, gap_s, charge, imbalance},
// channels[].quality {snr_db, averaged, averaged_second, drift, unrest, level_after, doubtful}, channels[].flagged
// {clipped, truncated, incomplete, under_sampled, coarse, flat_top}; load {voltage, current, pulses, load_ohm,
// load_uncertainty_ohm, impedance_ohm, charge_c, second_charge_c, net_charge_c, energy_j} or null.
//
// Thread-safety: pure functions; those that print are as safe as Say.h.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/Result.h"
#include "core/measure/LoadMeasurement.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::cli {

/// Adds the keys above to the JSON of one channel.
void addTrust(nlohmann::json& channel, const ChannelMeasurement& m);
/// Prints the values, a line of expanded uncertainties (k = 2) and a line on the signal's quality.
void printChannel(const ChannelMeasurement& m);

/// Returns the load if the capture has exactly one channel in V and one in A.
[[nodiscard]] std::optional<LoadMeasurement> loadIn(const Capture& capture, const MeasureOptions& options);
[[nodiscard]] nlohmann::json loadJson(const std::optional<LoadMeasurement>& load);
void printLoad(const LoadMeasurement& load);

}  // namespace tacto::cli
