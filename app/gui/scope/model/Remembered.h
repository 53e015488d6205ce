// Remembered.h - values read back from the settings file, which a person may have edited or a crash cut short: what is
// not there, not of its kind or out of range is nothing, and the reader's default stays.
//
// Thread-safety: as QSettings, the GUI thread.
#pragma once

#include <QSettings>
#include <optional>

namespace tacto::gui {

/// A finite number from `low` to `high`.
[[nodiscard]] std::optional<double> rememberedNumber(const QSettings& settings, const QString& key, double low,
                                                     double high);
/// "true" or "false"; anything else is nothing, not true.
[[nodiscard]] std::optional<bool> rememberedFlag(const QSettings& settings, const QString& key);

}  // namespace tacto::gui
