#include "app/gui/calibrate/CalibrationReadings.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/gui/theme/Text.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/base/JsonText.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::gui {

namespace {

/// Largest relative difference of equal currents: if the current follows a measured load, it varies each time.
constexpr double kSameCurrent = 0.02;
constexpr double kSameCommand = 1e-9;

SweepDirection directionOf(const std::string& word) {
    return valueFor(kSweepDirections, word).value_or(SweepDirection::None);
}

}  // namespace

void CalibrationReadings::judge() {
    fit.reset();
    uncertainty.clear();
    CalibrationOptions options;
    options.sameLevel = unit == "mA" ? kSameCurrent : kSameCommand;
    options.resolution = resolution;
    auto found = fitCalibration(readings, options);
    if (!found) return;  // with only one level there is no line yet
    readings = found->readings;
    fit = std::move(*found);
}

const ToleranceUse* CalibrationReadings::nearest() const {
    const auto most = std::max_element(
        used.begin(), used.end(), [](const ToleranceUse& a, const ToleranceUse& b) { return a.share() < b.share(); });
    return most == used.end() ? nullptr : &*most;
}

std::string calibratedQuantity(const nlohmann::json& trial) {
    if (!trial.is_object() || !trial.contains("commanded") || !trial["commanded"].is_object()) return {};
    const auto condition = textOr(trial, "condition");
    const auto word = condition.substr(0, condition.find(' '));
    return tacto::calibratedQuantity(word) != nullptr ? word : std::string();
}

CalibrationReading readingFrom(const nlohmann::json& trial) {
    const auto* quantity = tacto::calibratedQuantity(calibratedQuantity(trial));
    CalibrationReading reading;
    reading.commanded = std::nan("");
    if (quantity == nullptr) return reading;
    reading.commanded = numberOr(trial["commanded"], quantity->reading.data());
    reading.measured = numberOr(trial, quantity->reading.data());
    const auto condition = textOr(trial, "condition");
    reading.direction = directionOf(condition.substr(condition.rfind(' ') + 1));
    return reading;
}

QString unitFrom(const nlohmann::json& trial) {
    return calibratedQuantity(trial) == "amplitude" ? QString::fromStdString(textOr(trial, "unit")) : QString("s");
}

double toleranceOf(const std::string& quantity, const nlohmann::json& parameters) {
    const double found = numberOr(parameters, quantity == "amplitude" ? "tolerance_pct" : "timing_tolerance_pct");
    return std::isfinite(found) ? found : 0;
}

std::optional<CalibrationReadings> readingsFrom(const std::string& quantity, const nlohmann::json& found) {
    if (tacto::calibratedQuantity(quantity) == nullptr || !found.is_object() || !found.contains("readings") ||
        !found.contains("levels"))
        return std::nullopt;
    CalibrationReadings out;
    out.quantity = quantity;
    out.unit = QString::fromStdString(textOr(found, "unit"));
    const double tolerance = numberOr(found, "tolerance_pct");
    out.tolerance_pct = std::isfinite(tolerance) ? tolerance : 0;
    for (const auto& row : found["readings"]) {
        CalibrationReading reading;
        reading.commanded = numberOr(row, "commanded");
        reading.measured = numberOr(row, "measured");
        reading.direction = directionOf(textOr(row, "direction"));
        reading.outlier = row.value("outlier", false);
        out.readings.push_back(reading);
    }
    out.gainExpanded = numberOr(found, "gain_expanded_uncertainty");
    out.offsetExpanded = numberOr(found, "offset_expanded_uncertainty");
    out.verdict = QString::fromStdString(textOr(found, "verdict"));
    Calibration fit;
    fit.gain = numberOr(found, "gain");
    fit.offset = numberOr(found, "offset");
    for (const auto& row : found["levels"]) {
        CalibrationLevel level;
        level.commanded = numberOr(row, "commanded");
        level.mean = numberOr(row, "mean");
        level.meanUp = numberOr(row, "mean_up");
        level.meanDown = numberOr(row, "mean_down");
        fit.levels.push_back(level);
        out.uncertainty.push_back(numberOr(row, "expanded_uncertainty"));
        // Sessions of earlier versions have only the mean's error.
        const bool worst = row.contains("worst_error");
        const ToleranceUse use{level.commanded, numberOr(row, worst ? "worst_error" : "error"),
                               numberOr(row, worst ? "worst_expanded_uncertainty" : "expanded_uncertainty"),
                               numberOr(row, "tolerance")};
        if (std::isfinite(use.share())) out.used.push_back(use);
    }
    out.fit = std::move(fit);
    return out;
}

void takeCheck(CalibrationReadings& readings, const nlohmann::json& rows) {
    const auto* known = tacto::calibratedQuantity(readings.quantity);
    Calibration line;
    std::vector<double> expected;
    std::optional<Verdict> worst;
    readings.used.clear();
    readings.uncertainty.clear();
    for (const auto& row : rows) {
        if (known == nullptr || textOr(row, "quantity") != readings.quantity) continue;
        const auto value = [&](const char* key) { return numberOr(row, key) / known->perUnit; };
        CalibrationLevel level;
        level.commanded = value("commanded");
        level.mean = value("measured");
        line.levels.push_back(level);
        expected.push_back(value("expected"));
        readings.uncertainty.push_back(value("expanded_uncertainty"));
        const ToleranceUse use{level.commanded, value("off"), value("expanded_uncertainty"), value("allowed")};
        if (std::isfinite(use.share())) readings.used.push_back(use);
        const auto verdict = valueFor(kVerdicts, textOr(row, "verdict")).value_or(Verdict::Indeterminate);
        worst = worst ? worseOf(*worst, verdict) : verdict;
    }
    if (!worst) return;
    // The expected values lie on the stored line.
    const double reach = line.levels.back().commanded - line.levels.front().commanded;
    line.gain = reach != 0 ? (expected.back() - expected.front()) / reach : 1;
    line.offset = expected.front() - line.gain * line.levels.front().commanded;
    readings.fit = std::move(line);
    readings.checks = true;
    readings.verdict = qtext(nameOf(*worst));
}

QString quantityTitle(const std::string& quantity) {
    const auto* known = tacto::calibratedQuantity(quantity);
    return known != nullptr ? qtext(known->title) : QString::fromStdString(quantity);
}

}  // namespace tacto::gui
