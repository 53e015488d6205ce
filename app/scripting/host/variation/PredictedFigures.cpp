// Figures of a prediction, marked as predictions.
#include "app/scripting/host/variation/PredictedFigures.h"

#include <algorithm>
#include <fmt/format.h>

namespace tacto::host::variation {

namespace {

constexpr const char* kMarked = "Simulated: predicted, not measured.";

Json curvesOf(const char* x, const char* unitOfX, const char* y, Json curves) {
    return {{"type", "curves"},
            {"x", {{"label", x}, {"unit", unitOfX}}},
            {"y", {{"label", y}, {"unit", "%"}}},
            {"curves", std::move(curves)},
            {"note", kMarked}};
}

/// Returns the share of participants at or below each value of a sorted list. More points than a page can show would
/// only enlarge the report; the last point is always included.
Json shareCurve(std::string label, const std::vector<double>& sorted, double scale, std::size_t points) {
    Json x = Json::array(), y = Json::array();
    const std::size_t step = 1 + sorted.size() / points;
    for (std::size_t i = sorted.empty() ? 0 : (sorted.size() - 1) % step; i < sorted.size(); i += step) {
        x.push_back(scale * sorted[i]);
        y.push_back(100 * static_cast<double>(i + 1) / static_cast<double>(sorted.size()));
    }
    return {{"label", std::move(label)}, {"x", std::move(x)}, {"y", std::move(y)}, {"steps", true}};
}

}  // namespace

Json predictedConfusion(const Variation& found) {
    Json labels = Json::array();
    for (const auto& condition : found.conditions) labels.push_back(condition.name);
    Json columns = labels;
    columns.push_back("none");
    return {{"type", "confusion"},
            {"labels", std::move(labels)},
            {"columns", std::move(columns)},
            {"confusion", found.confusion},
            {"note", kMarked}};
}

Json accuracyCurve(const Variation& found) {
    return curvesOf("Expected accuracy", "%", "Participants at or below",
                    Json::array({shareCurve("virtual participants", found.accuracies, 100, 400)}));
}

Json widthCurve(const Variation& found, const TrialsWanted& wanted) {
    Json curves = Json::array(), lines = Json::array();
    if (found.trials) {
        Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();
        for (const auto& point : found.trials->curve) {
            x.push_back(point.trials);
            y.push_back(100 * point.width.value);
            low.push_back(100 * point.width.low);
            high.push_back(100 * point.width.high);
        }
        curves.push_back(
            {{"label", "one participant, median and 5 to 95 %"}, {"x", x}, {"y", y}, {"low", low}, {"high", high}});
        lines.push_back({{"label", "wanted"}, {"y", 100 * wanted.width}});
    }
    auto figure = curvesOf("Trials of a participant", "", "Width of the 95 % interval", std::move(curves));
    figure["lines"] = std::move(lines);
    return figure;
}

Json thresholdCurves(const Variation& found, const EncodingProfile& encoding) {
    Json curves = Json::array();
    const auto add = [&](std::string label, auto value) {
        std::vector<double> values;
        for (const auto& person : found.people) values.push_back(value(person));
        std::ranges::sort(values);
        curves.push_back(shareCurve(std::move(label), values, 1, values.size() + 1));
    };
    using Person = ParticipantPrediction;
    add("felt from", [](const Person& p) { return p.who.detection.value(); });
    add("too strong from", [](const Person& p) { return p.who.discomfort.value(); });
    add("not tolerated from", [](const Person& p) { return p.who.intolerance.value(); });
    for (const auto volts : {encoding.amplitudeMin.value(), encoding.amplitudeMax.value()})
        add(fmt::format("current at {:g} V", volts),
            [volts](const Person& p) { return 1e3 * volts / p.delivery.impedance.value(); });
    return curvesOf("Current", "mA", "Participants at or below", std::move(curves));
}

}  // namespace tacto::host::variation
