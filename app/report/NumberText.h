// NumberText.h - how numbers stand in a report: as core/base/QuantityText.h writes them everywhere, with a narrow space
// before the unit and a true minus; and how columns and cells of tables are written.
#pragma once

#include <QJsonValue>
#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto {

/// "2.26 mA", "10.0 kΩ"; a unit that takes no prefix ("%", "") gives "12.3 %". `unit` may be ASCII ("ohm", "uC").
[[nodiscard]] QString quantityText(double value, const QString& unit, int digits = 4);

/// A value and its uncertainty, "40.12 ± 0.46 V", as uncertainText(); one that is not known is left out.
[[nodiscard]] QString quantityText(double value, double uncertainty, const QString& unit);

/// A mean and its standard deviation, "40.12, s.d. 0.46 V": ± is kept for uncertainties and tolerances. A deviation
/// that is not known (of one reading, say) is left out.
[[nodiscard]] QString spreadText(double mean, double sd, const QString& unit);

/// A value and its expanded uncertainty after GUM 7.2.6, as measuredText() of core/base/QuantityText.h: one that is not
/// known is said to be unknown (hazard H9).
[[nodiscard]] QString uncertainText(double value, double expanded, const QString& unit);

/// An estimate and its interval, to two significant digits of half the interval (GUM 7.2.6): "1.00 (0.63 to 1.00)",
/// "1.50 V (1.20 to 1.80 V)". The value alone where the bounds are not known.
[[nodiscard]] QString intervalText(const Estimate& estimate, const QString& unit);

/// A setting, without padding zeros: "1 kΩ", "25", "0.15 N".
[[nodiscard]] QString settingText(double value, const QString& unit);

/// A tolerance as an instrument states it, without padding zeros and with two digits at most, for a tolerance is not
/// known better: "0.5 %", "80 µA".
[[nodiscard]] QString toleranceText(double value, const QString& unit);

/// How long something took: "45 s", "5 min 43 s", "2 h 5 min".
[[nodiscard]] QString durationText(double seconds);

/// "99.0 % (94.6 to 99.8 %)" of an estimate of a proportion.
[[nodiscard]] QString proportionText(const Estimate& estimate);

/// The prefix that suits an axis reaching `maxAbs`: multiply by `factor`, label with `unit`.
struct AxisUnit {
    double factor = 1;
    QString unit;
};
[[nodiscard]] AxisUnit axisUnit(double maxAbs, const QString& unit);

/// A table's column, from the key that a result carries: "net_charge_uc" → "Net charge", values in µC.
struct ColumnName {
    QString title;
    QString unit;  ///< the shown unit; empty for plain numbers
};
[[nodiscard]] ColumnName columnName(const QString& key);

/// One prefix and as many decimals for all numbers of a column, where they lie within a factor of 1000 of each other,
/// since compared numbers should look alike. Nothing otherwise, or for whole numbers without a unit.
struct ColumnFormat {
    int exponent = 0;
    int decimals = 0;
};
[[nodiscard]] std::optional<ColumnFormat> columnFormat(const std::vector<double>& values, const QString& unit);
[[nodiscard]] QString quantityText(double value, const QString& unit, const ColumnFormat& format);

/// `text` with the signs that a page has and a script's source need not: a minus before a number in place of a hyphen
/// (dates and ranges keep theirs), Ω after a number in place of ohm, cm² in place of cm2.
[[nodiscard]] QString withSigns(QString text);

/// "1 000 000" of "1000000": numbers of five digits and more before their decimals.
[[nodiscard]] QString grouped(QString words);

/// One prefix for all figures of a unit that stand in one column: "620.0 µV" above "45.25 mV" becomes "0.6200 mV". Its
/// digits stay, the point moves; the prefix is the largest that is met, or a smaller one where that is much shorter and
/// needs no zero that says nothing. Sentences, and cells of two units, stay as they are.
void sharePrefix(const std::vector<QString*>& cells);
void sharePrefix(QStringList& cells);

/// True for a figure as it stands in a cell: "5.03 mA", "± 200 mV", "−0.3 ± 1.2 %", "40.12, s.d. 0.46 V".
[[nodiscard]] bool isFigure(const QString& text);

/// Takes the unit that all numbers of a column share out of its cells, for the header; empty where they share none.
[[nodiscard]] QString takeUnit(QStringList& cells);

/// Puts the decimal points of a column of numbers one below the other where all have the same unit: fills the places
/// that a number lacks with spaces as wide as a digit and a point. Cells without a number stay as they are.
void alignPoints(QStringList& cells);

/// `text` with every character that moves a cursor, turns the reading direction or cannot be seen as U+FFFD: what a
/// script, a file or a device said never reaches a reader's terminal or page as a command.
[[nodiscard]] QString visible(const QString& text);
/// A table's cell: a number, text, flag, statistic or estimate; null is "–".
[[nodiscard]] QString cellText(const QJsonValue& value, const QString& unit);

}  // namespace tacto
