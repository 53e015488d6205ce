#include "app/gui/theme/ExposureText.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gui {

namespace {

constexpr QChar kBeforeUnit(0x202f);
constexpr int kMaxDecimals = 4;  // digits of a value just below its limit

ExposureFigure split(const QString& quantity) {
    const auto end = quantity.indexOf(kBeforeUnit);
    return end < 0 ? ExposureFigure{quantity, {}} : ExposureFigure{quantity.left(end), quantity.mid(end + 1)};
}

QString joined(const ExposureFigure& figure) {
    return figure.unit.isEmpty() ? figure.number : figure.number + kBeforeUnit + figure.unit;
}

/// Three digits, and no more decimals than matter beside `limit`.
QString numberBeside(double value, double limit, int limitDecimals) {
    if (value == 0) return QStringLiteral("0");
    const int most = limit < 1 ? 3 : limit < 100 ? 2 : 1;
    const double least = std::pow(10.0, -most);
    if (value < least) return "< " + decimalText(least, most);
    const int digits = value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
    const int decimals = std::max(std::min(most, digits == 2 && limit < 1 ? 3 : digits), limitDecimals);
    const auto said = decimalText(value, decimals);
    // What keeps its limit does not read as at it.
    for (int finer = decimals; value < limit && finer <= kMaxDecimals; ++finer) {
        if (const auto below = decimalText(value, finer); below.toDouble() < limit) return below;
    }
    return value > limit && !(said.toDouble() > limit) ? "> " + decimalText(limit, limitDecimals) : said;
}

}  // namespace

ExposureFigure figureOf(const ExposureRow& row) {
    const auto unit = qtext(row.unit);
    if (std::isnan(row.limit)) return split(quantityText(row.value, unit, 3));
    const auto limit = split(settingText(row.limit, unit));
    bool isNumber = false;
    const double number = limit.number.toDouble(&isNumber);
    const double share = row.value / row.limit;
    if (!isNumber || !(number > 0) || !std::isfinite(share) || share < 0)
        return split(quantityText(row.value, unit, 3));
    const auto point = limit.number.indexOf('.');
    const int limitDecimals = point < 0 ? 0 : int(limit.number.size() - point - 1);
    return {numberBeside(share * number, number, limitDecimals), limit.unit};
}

QString valueText(const ExposureRow& row) { return joined(figureOf(row)); }

QString valueOfLimitText(const ExposureRow& row) {
    auto limit = split(settingText(row.limit, qtext(row.unit)));
    const auto value = figureOf(row);
    const bool oneUnit = value.unit == limit.unit;
    if (needsArea(row.quantity)) limit.unit.remove(QStringLiteral("/cm²"));
    if (value.number.startsWith('>')) return "> " + joined(limit);
    return QObject::tr("%1 of %2").arg(oneUnit ? value.number : joined(value), joined(limit));
}

QString measuredText(const ExposureRow& row) {
    if (std::isnan(row.measured)) return {};
    auto shown = row;
    shown.value = row.measured;
    // Beside its limit it would read "> 40 V": how far above it is said here.
    shown.limit = std::nan("");
    return (row.beyond ? QObject::tr("⚠ %1 measured") : QObject::tr("%1 measured")).arg(valueText(shown));
}

}  // namespace tacto::gui
