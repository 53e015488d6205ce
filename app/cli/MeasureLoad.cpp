#include "app/cli/MeasureLoad.h"

#include <algorithm>
#include <fmt/format.h>

#include "app/cli/Say.h"
#include "app/cli/TextTable.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

namespace {

template <class Flag>
std::size_t countOf(const ChannelMeasurement& m, Flag flag) {
    return static_cast<std::size_t>(
        std::count_if(m.pulses.begin(), m.pulses.end(), [&](const auto& p) { return flag(p.flags); }));
}

TextTable statisticsTable() { return TextTable({"", ">", ""}); }

/// Adds nothing if nothing was measured.
void addStatistic(TextTable& table, const char* name, const Statistics& s, std::string_view unit) {
    if (s.n == 0) return;
    table.add({name, scaledText(s.mean, unit, 4),
               fmt::format("(sd {}, {} to {}, n = {})", scaledText(s.sd, unit, 2), scaledText(s.min, unit, 4),
                           scaledText(s.max, unit, 4), s.n)});
}

std::string uncertaintiesOf(const ChannelMeasurement& m) {
    const auto& u = m.uncertainty;
    const auto text = [](double standard, std::string_view unit) {
        return std::isfinite(standard) ? scaledText(kCoverage * standard, unit, 2) : std::string("not known");
    };
    auto line = fmt::format("uncertainty (k = {:.0f}): amplitude {}, width {}", kCoverage, text(u.amplitude, m.unit),
                            text(u.width_s, "s"));
    if (m.interval_s.n > 0) line += ", interval " + text(u.interval_s, "s");
    if (m.gap_s.n > 0) line += ", gap " + text(u.gap_s, "s");
    if (m.imbalance.n > 0 && std::isfinite(u.imbalance))
        line += fmt::format(", imbalance {:.2g} %", 100 * kCoverage * u.imbalance);
    return line;
}

}  // namespace

void printChannel(const ChannelMeasurement& m) {
    auto table = statisticsTable();
    addStatistic(table, "amplitude", m.amplitude, m.unit);
    addStatistic(table, "width", m.width_s, "s");
    addStatistic(table, "interval", m.interval_s, "s");
    addStatistic(table, "rise", m.rise_s, "s");
    addStatistic(table, "fall", m.fall_s, "s");
    addStatistic(table, "gap", m.gap_s, "s");
    if (m.imbalance.n > 0) table.add({"imbalance", fmt::format("{:.3g} %", 100 * m.imbalance.mean)});
    if (m.measuredPulses > 0) {
        if (m.quality.foundStep > 0) {
            table.add({"resolution", scaledText(m.quality.foundStep, m.unit, 3), "not stated, found in the samples"});
        }
        table.addLine(uncertaintiesOf(m));
        if (std::isfinite(m.quality.snr_db)) table.add({"above noise", fmt::format("{:.1f} dB", m.quality.snr_db)});
    }
    table.print();
}

void addTrust(nlohmann::json& channel, const ChannelMeasurement& m) {
    const auto& u = m.uncertainty;
    const auto expanded = [](double standard) { return numberOrNull(kCoverage * standard); };
    channel["uncertainty"] = {{"coverage_factor", kCoverage},      {"amplitude", expanded(u.amplitude)},
                              {"width_s", expanded(u.width_s)},    {"interval_s", expanded(u.interval_s)},
                              {"gap_s", expanded(u.gap_s)},        {"charge", expanded(u.charge)},
                              {"imbalance", expanded(u.imbalance)}};
    const auto& q = m.quality;
    channel["quality"] = {{"snr_db", numberOrNull(q.snr_db)},
                          {"averaged", q.mean},
                          {"averaged_second", q.meanOfSecond},
                          {"resolution_found", q.foundStep > 0 ? nlohmann::json(q.foundStep) : nlohmann::json()},
                          {"samples_left_out", q.leaps},
                          {"drift", q.drift},
                          {"unrest", q.unrest},
                          {"level_after", q.levelAfter},
                          {"doubtful", q.doubtful}};
    channel["flagged"] = {{"clipped", countOf(m, [](const auto& f) { return f.clipped; })},
                          {"truncated", countOf(m, [](const auto& f) { return f.truncated; })},
                          {"incomplete", countOf(m, [](const auto& f) { return f.incomplete; })},
                          {"under_sampled", countOf(m, [](const auto& f) { return f.underSampled; })},
                          {"coarse", countOf(m, [](const auto& f) { return f.coarse && f.measured(); })},
                          {"flat_top", countOf(m, [](const auto& f) { return f.flatTop && f.measured(); })}};
}

std::optional<LoadMeasurement> loadIn(const Capture& capture, const MeasureOptions& options) {
    const auto channels = loadChannels(capture);
    if (!channels) return std::nullopt;
    auto load = measureLoad(capture, channels->first, channels->second, options);
    if (!load) return std::nullopt;  // the channels are those that loadChannels() found
    return *std::move(load);
}

nlohmann::json loadJson(const std::optional<LoadMeasurement>& load) {
    if (!load) return nullptr;
    return {{"voltage", load->voltage},
            {"current", load->current},
            {"pulses", load->measuredPulses},
            {"load_ohm", toJson(load->load_ohm)},
            {"load_uncertainty_ohm", numberOrNull(kCoverage * load->loadUncertainty_ohm)},
            {"impedance_ohm", toJson(load->impedance_ohm)},
            {"charge_c", toJson(load->charge_c)},
            {"second_charge_c", toJson(load->secondCharge_c)},
            {"net_charge_c", toJson(load->netCharge_c)},
            {"energy_j", toJson(load->energy_j)}};
}

void printLoad(const LoadMeasurement& load) {
    if (load.measuredPulses == 0) return;
    say("load: {} over {}, {} pulses, uncertainty (k = {:.0f}) {}\n", load.voltage, load.current, load.measuredPulses,
        kCoverage,
        std::isfinite(load.loadUncertainty_ohm) ? scaledText(kCoverage * load.loadUncertainty_ohm, "ohm", 2)
                                                : "not known");
    auto table = statisticsTable();
    addStatistic(table, "load", load.load_ohm, "ohm");
    addStatistic(table, "impedance", load.impedance_ohm, "ohm");
    addStatistic(table, "charge", load.charge_c, "C");
    addStatistic(table, "second charge", load.secondCharge_c, "C");
    addStatistic(table, "net charge", load.netCharge_c, "C");
    addStatistic(table, "energy", load.energy_j, "J");
    table.print();
}

}  // namespace tacto::cli
