// Remembered.h - values read back from the settings file, which a person may have edited or a crash cut short: a value
// that is missing, of another kind or out of range is nothing, and the reader's default stays.
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

/// The user's choice of view for the bench's captures, kept from one start to the next; nothing: all of it is shown.
struct ChosenView {
    struct Time {
        double left_s = 0, perDivision_s = 0;
    };
    std::optional<Time> time;
    std::map<QString, LaneScale> lanes;  ///< empty: fitted
};

void saveView(QSettings& settings, const ChosenView& chosen);
/// Leaves out what is missing, or was not written by saveView().
[[nodiscard]] ChosenView restoredView(QSettings& settings);

}  // namespace tacto::gui
