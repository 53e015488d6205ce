#include "app/report/StudyText.h"

#include <cmath>

#include "core/base/QuantityText.h"

namespace tacto {

QString peopleHeading(SessionBasis basis) {
    const auto words = peopleOf(basis);
    auto text = QString::fromUtf8(words.data(), qsizetype(words.size()));
    return text.replace(0, 1, text.at(0).toUpper());
}

QString figureText(double value, int decimals) { return QString::fromStdString(decimalText(value, decimals)); }

QString shareText(const Estimate& share) {
    if (!std::isfinite(share.value)) return "–";
    return QString("%1 % (%2 to %3)")
        .arg(figureText(100 * share.value, 0), figureText(100 * share.low, 0), figureText(100 * share.high, 0));
}

}  // namespace tacto
