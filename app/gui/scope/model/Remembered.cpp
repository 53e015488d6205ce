#include "app/gui/scope/model/Remembered.h"

#include <algorithm>
#include <cmath>

namespace tacto::gui {

std::optional<double> rememberedNumber(const QSettings& settings, const QString& key, double low, double high) {
    bool isNumber = false;
    const double value = settings.value(key).toDouble(&isNumber);
    if (!isNumber || !std::isfinite(value) || value < low || value > high) return std::nullopt;
    return value;
}

std::optional<bool> rememberedFlag(const QSettings& settings, const QString& key) {
    const auto text = settings.value(key).toString();
    if (text == "true") return true;
    if (text == "false") return false;
    return std::nullopt;
}

namespace {

constexpr int kMaxLanes = 64;
constexpr double kFurthest = 1000;  ///< farthest a lane's zero can lie from the middle, in divisions

}  // namespace

void saveView(QSettings& settings, const ChosenView& chosen) {
    settings.remove("time");
    if (chosen.time) {
        settings.setValue("time/perDivision", chosen.time->perDivision_s);
        settings.setValue("time/left", chosen.time->left_s);
    }
    settings.remove("lanes");
    settings.beginWriteArray("lanes");
    int index = 0;
    for (const auto& [key, scale] : chosen.lanes) {
        settings.setArrayIndex(index++);
        settings.setValue("key", key);
        settings.setValue("perDivision", scale.perDivision);
        settings.setValue("position", scale.position);
    }
    settings.endArray();
}

ChosenView restoredView(QSettings& settings) {
    ChosenView chosen;
    const auto perDivision = rememberedNumber(settings, "time/perDivision", 1e-9, 1e4);
    const auto left = rememberedNumber(settings, "time/left", -1e7, 1e7);
    if (perDivision && left) chosen.time = ChosenView::Time{*left, *perDivision};
    const int lanes = std::clamp(settings.beginReadArray("lanes"), 0, kMaxLanes);
    for (int i = 0; i < lanes; ++i) {
        settings.setArrayIndex(i);
        const auto key = settings.value("key").toString();
        const auto scale = rememberedNumber(settings, "perDivision", 1e-12, 1e6);
        const auto position = rememberedNumber(settings, "position", -kFurthest, kFurthest);
        if (!key.isEmpty() && scale && position) chosen.lanes[key] = LaneScale{*scale, *position};
    }
    settings.endArray();
    return chosen;
}

}  // namespace tacto::gui
