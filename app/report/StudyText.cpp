#include "app/report/StudyText.h"

#include <cmath>

namespace tacto {

QString peopleHeading(SessionBasis basis) {
    const auto words = peopleOf(basis);
    auto text = QString::fromUtf8(words.data(), qsizetype(words.size()));
    return text.replace(0, 1, text.at(0).toUpper());
}

QString figureText(double value, int decimals) {
    return std::isfinite(value) ? QString::number(value, 'f', decimals) : QString("–");
}

QString shareText(const Estimate& share) {
    if (!std::isfinite(share.value)) return "–";
    return QString("%1 % (%2 to %3)")
        .arg(100 * share.value, 0, 'f', 0)
        .arg(100 * share.low, 0, 'f', 0)
        .arg(100 * share.high, 0, 'f', 0);
}

}  // namespace tacto
