// Remembered.h - values read back from the settings file, which a person may have edited or a crash cut short: what is
// not there, not of its kind or out of range is nothing, and the reader's default stays.
//
// Thread-safety: as QSettings, the GUI thread.
#pragma once

#include <QSettings>
#include <optional>

#include "app/gui/scope/model/Viewport.h"

namespace tacto::gui {

/// A finite number from `low` to `high`.
[[nodiscard]] std::optional<double> rememberedNumber(const QSettings& settings, const QString& key, double low,
                                                     double high);
/// "true" or "false"; anything else is nothing, not true.
[[nodiscard]] std::optional<bool> rememberedFlag(const QSettings& settings, const QString& key);

/// What the user chose to see of the bench's captures, kept from one start to the next; nothing: the whole is shown.
struct ChosenView {
    struct Time {
        double left_s = 0, perDivision_s = 0;
    };
    std::optional<Time> time;
    std::map<QString, LaneScale> lanes;  ///< empty: fitted
};

void saveView(QSettings& settings, const ChosenView& chosen);
/// What is not there, or was not written by saveView(), is left out.
[[nodiscard]] ChosenView restoredView(QSettings& settings);

}  // namespace tacto::gui
