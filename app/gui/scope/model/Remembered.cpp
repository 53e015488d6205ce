#include "app/gui/scope/model/Remembered.h"

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

}  // namespace tacto::gui
