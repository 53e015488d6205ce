// NumberText.h - formats numbers for a report as core/base/QuantityText.h does, but with a narrow space before the unit
// and a true minus; formats columns and cells of tables.
#pragma once

#include <QJsonValue>
#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// "2.26 mA", "10.0 kΩ"; a unit without prefixes ("%", "") gives "12.3 %". `unit` may be ASCII ("ohm", "uC").
[[nodiscard]] QString quantityText(double value, const QString& unit, int digits = 4);

/// Returns a value with its uncertainty, "40.12 ± 0.46 V", like uncertainText(); an unknown uncertainty is left out.
[[nodiscard]] QString quantityText(double value, double uncertainty, const QString& unit);

/// Returns a mean with its standard deviation, "40.12, s.d. 0.46 V": ± is reserved for uncertainties and tolerances. An
/// unknown deviation (of a single reading) is left out.
[[nodiscard]] QString spreadText(double mean, double sd, const QString& unit);

/// Returns a value with its expanded uncertainty (GUM 7.2.6), like measuredText() of core/base/QuantityText.h: an
/// unknown uncertainty is stated as unknown (hazard H9).
[[nodiscard]] QString uncertainText(double value, double expanded, const QString& unit);

/// Returns an estimate with its interval, to two significant digits of half the interval (GUM 7.2.6): "1.00 (0.63 to
/// 1.00)", "1.50 V (1.20 to 1.80 V)". If the bounds are not known, only the value.
[[nodiscard]] QString intervalText(const Estimate& estimate, const QString& unit);

/// Returns a setting without padding zeros: "1 kΩ", "25", "0.15 N".
[[nodiscard]] QString settingText(double value, const QString& unit);

/// Returns a tolerance as an instrument states it, without padding zeros and with at most two digits, because a
/// tolerance is not known better: "0.5 %", "80 µA".
[[nodiscard]] QString toleranceText(double value, const QString& unit);

/// Returns a duration: "45 s", "5 min 43 s", "2 h 5 min".
[[nodiscard]] QString durationText(double seconds);

/// Returns an estimate of a proportion: "99.0 % (94.6 to 99.8 %)".
[[nodiscard]] QString proportionText(const Estimate& estimate);

/// The prefix for an axis that reaches `maxAbs`: multiply by `factor`, label with `unit`.
struct AxisUnit {
    double factor = 1;
    QString unit;
};
[[nodiscard]] AxisUnit axisUnit(double maxAbs, const QString& unit);

/// Title and unit of a table's column, from its key in a result: "net_charge_uc" → "Net charge", values in µC.
struct ColumnName {
    QString title;
    QString unit;  ///< as shown; empty for plain numbers
};
[[nodiscard]] ColumnName columnName(const QString& key);

/// One prefix and number of decimals for a column of numbers within a factor of 1000 of each other, so that they are
/// easy to compare. Nothing otherwise, or for whole numbers without a unit.
struct ColumnFormat {
    int exponent = 0;
    int decimals = 0;
};
[[nodiscard]] std::optional<ColumnFormat> columnFormat(const std::vector<double>& values, const QString& unit);
[[nodiscard]] QString quantityText(double value, const QString& unit, const ColumnFormat& format);

/// Returns `text` with typographic signs: a minus instead of a hyphen before a number (dates and ranges keep the
/// hyphen), Ω instead of ohm after a number, cm² instead of cm2.
[[nodiscard]] QString withSigns(QString text);

/// Returns "1 000 000" for "1000000": groups numbers with five or more digits before the decimal point.
[[nodiscard]] QString grouped(QString words);

/// Gives all figures of one unit in a column the same prefix: "620.0 µV" above "45.25 mV" becomes "0.6200 mV". The
/// digits stay, the point moves. The prefix is the largest in the column, or a smaller one if that is much shorter and
/// adds no meaningless zero; a figure of less than a thousandth of the largest has one with its like. Sentences, and
/// cells with two units, do not change.
void sharePrefix(const std::vector<QString*>& cells);
void sharePrefix(QStringList& cells);
/// Gives all figures of the largest one's unit its prefix, however small they are: "2 mV" beside "40 V" becomes
/// "0.002 V".
void useOneUnit(const std::vector<QString*>& cells);

/// True for a figure in a table cell: "5.03 mA", "± 200 mV", "−0.3 ± 1.2 %", "40.12, s.d. 0.46 V".
[[nodiscard]] bool isFigure(const QString& text);

/// Removes the unit that all numbers of a column share from its cells and returns it for the header; empty if none.
[[nodiscard]] QString takeUnit(QStringList& cells);

/// Aligns the decimal points of a column if all numbers have the same unit: fills missing places with spaces as wide as
/// a digit and a point. Cells without a number do not change.
void alignPoints(QStringList& cells);

/// Replaces every character that moves a cursor, changes the reading direction or is invisible by U+FFFD: text from a
/// script, file or device must not act as a command on a terminal or page.
[[nodiscard]] QString visible(const QString& text);
/// Returns the text of a table's cell: a number, text, flag, statistic or estimate; null gives "–".
[[nodiscard]] QString cellText(const QJsonValue& value, const QString& unit);

}  // namespace tacto
