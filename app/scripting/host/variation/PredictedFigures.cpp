// Figures of a prediction, marked as predictions.
#include "app/scripting/host/variation/PredictedFigures.h"

#include <algorithm>

namespace tacto::host::variation {

namespace {

constexpr const char* kMarked = "Simulated: predicted, not measured.";

/// Returns the share of participants at or below each accuracy.
Json accuracyCurve(const Json& found) {
    Json x = Json::array(), y = Json::array();
    const Json& values = found["accuracies"];
    const double n = static_cast<double>(values.size());
    // More points than a page can show would only enlarge the report; the last point is always included.
    constexpr std::size_t kPoints = 400;
    const std::size_t step = 1 + values.size() / kPoints;
    const std::size_t first = values.empty() ? 0 : (values.size() - 1) % step;
    for (std::size_t i = first; i < values.size(); i += step) {
        x.push_back(100 * values[i].get<double>());
        y.push_back(100 * static_cast<double>(i + 1) / n);
    }
    return {{"type", "curves"},
            {"x", {{"label", "Expected accuracy"}, {"unit", "%"}}},
            {"y", {{"label", "Participants at or below"}, {"unit", "%"}}},
            {"curves", {{{"label", "virtual participants"}, {"x", x}, {"y", y}, {"steps", true}}}},
            {"note", kMarked}};
}

Json widthCurve(const Json& found) {
    const Json trials = found.value("trials_needed", Json());
    Json curves = Json::array();
    Json lines = Json::array();
    if (trials.is_object()) {
        Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
        for (const auto& point : trials["curve"]) {
            x.push_back(point["trials"]);
            y.push_back(100 * point["width"]["value"].get<double>());
            low.push_back(100 * point["width"]["low"].get<double>());
            high.push_back(100 * point["width"]["high"].get<double>());
        }
        curves.push_back(
            {{"label", "one participant, median and 5 to 95 %"}, {"x", x}, {"y", y}, {"low", low}, {"high", high}});
        lines.push_back({{"label", "wanted"}, {"y", 100 * trials["width"].get<double>()}});
    }
    return {{"type", "curves"},
            {"x", {{"label", "Trials of a participant"}, {"unit", ""}}},
            {"y", {{"label", "Width of the 95 % interval"}, {"unit", "%"}}},
            {"curves", curves},
            {"lines", lines},
            {"note", kMarked}};
}

/// Returns the share of participants at or below each value.
Json shareCurve(std::string label, std::vector<double> values) {
    std::ranges::sort(values);
    Json x = Json::array(), y = Json::array();
    const double n = static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        x.push_back(values[i]);
        y.push_back(100 * static_cast<double>(i + 1) / n);
    }
    return {{"label", std::move(label)}, {"x", std::move(x)}, {"y", std::move(y)}, {"steps", true}};
}

/// Returns the thresholds, and the currents from the profile's smallest and largest amplitude (for a current source: A
/// / |Z|), even if these would be withheld.
Json thresholdCurves(const Json& found) {
    const Json& people = found.at("people");
    Json curves = Json::array();
    const std::pair<const char*, const char*> thresholds[] = {
        {"felt from", "detection_ma"}, {"too strong from", "discomfort_ma"}, {"not tolerated from", "intolerance_ma"}};
    for (const auto& [label, key] : thresholds) curves.push_back(shareCurve(label, people.at(key)));
    const std::vector<double> impedance = people.at("impedance_ohm");
    for (const double volts : found.at("range_v")) {
        std::vector<double> currents;
        for (const double ohms : impedance) currents.push_back(1e3 * volts / ohms);
        curves.push_back(shareCurve(fmt::format("current at {:g} V", volts), std::move(currents)));
    }
    return {{"type", "curves"},
            {"x", {{"label", "Current"}, {"unit", "mA"}}},
            {"y", {{"label", "Participants at or below"}, {"unit", "%"}}},
            {"curves", curves},
            {"note", kMarked}};
}

}  // namespace

Json predictedFigure(const Json& found, std::string_view view) {
    if (view == "accuracy") return accuracyCurve(found);
    if (view == "width") return widthCurve(found);
    if (view == "thresholds") return thresholdCurves(found);
    return {{"type", "confusion"},
            {"labels", found["labels"]},
            {"columns", found["columns"]},
            {"confusion", found["confusion"]},
            {"note", kMarked}};
}

}  // namespace tacto::host::variation
