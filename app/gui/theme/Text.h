// Text.h - turns texts of the core into the form that the window shows.
//
// Thread-safety: pure functions.
#pragma once

#include <QObject>
#include <QRegularExpression>
#include <QString>
#include <cmath>
#include <string_view>

#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "core/base/QuantityText.h"
#include "core/base/Result.h"
#include "core/kinds/ResultKinds.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

[[nodiscard]] inline QString qtext(std::string_view utf8) {
    return QString::fromUtf8(utf8.data(), qsizetype(utf8.size()));
}

/// Returns "Voltage" for "voltage", as in a report.
[[nodiscard]] inline QString titled(QString name) { return capitalised(std::move(name)); }

/// Like decimalText() in core, with a true minus sign and a narrow space before `unit`: "−0.98 %".
[[nodiscard]] inline QString decimalText(double value, int decimals, const QString& unit = {}) {
    const auto number = qtext(tacto::decimalText(value, decimals)).replace('-', QChar(0x2212));
    return unit.isEmpty() ? number : number + QChar(0x202f) + unit;
}

/// Returns "1:02.3" for 62.3 s: minutes and seconds.
[[nodiscard]] inline QString minutesText(double seconds) {
    const auto tenths = std::llround(seconds * 10);
    return QString("%1:%2").arg(tenths / 600).arg(static_cast<double>(tenths % 600) / 10, 4, 'f', 1, QChar('0'));
}

/// Returns a protocol's display name: "Encoding comparison" for "encoding-comparison", "Live" for no protocol. Sessions
/// store only the name. A shipped protocol is called after the kind of its results.
[[nodiscard]] inline QString procedureText(std::string_view protocol) {
    if (protocol.empty()) return QObject::tr("Live");
    const auto spoken = resultTraits(protocol).procedure;
    return titled(qtext(spoken.empty() ? protocol : spoken).replace('-', ' '));
}

/// Returns "the load of 2 kΩ" for "the load of 2 kohm".
[[nodiscard]] inline QString withOhmSigns(QString words) {
    static const QRegularExpression unit(R"((?<=\s)([kM]?)ohm\b)");
    return words.replace(unit, QStringLiteral("\\1Ω"));
}

/// Keeps a number and its unit on one line.
[[nodiscard]] inline QString keptTogether(QString words) {
    static const QRegularExpression between(
        R"((?<=\d) (?=(?:[kMmµnp]?(?:V|A|Ω|ohm|Hz|s|J|C|N|Pa|W)|%|min|cm²|m[AW]/cm²)(?![\w/])))");
    return words.replace(between, QStringLiteral("\u202f"));
}

/// Returns a count with grouped digits: "20 000".
[[nodiscard]] inline QString countText(std::size_t count) { return grouped(QString::number(qulonglong(count))); }

/// Returns "The load is open." for "the load is open".
[[nodiscard]] inline QString sentence(const QString& words) {
    const auto whole = titled(withOhmSigns(words));
    return whole.isEmpty() || whole.endsWith('.') ? whole : whole + '.';
}
/// Puts the last sentence into the past tense for later reading: the output may be on again by then.
[[nodiscard]] inline QString inThePast(QString words) {
    return words.replace(QObject::tr("Output is off."), QObject::tr("The output was switched off."));
}
[[nodiscard]] inline QString sentence(const Error& error) { return sentence(qtext(error.message)); }

/// True if `why` says that the device may not obey.
[[nodiscard]] inline bool saysMayBeOn(const QString& why) {
    return why.contains(qtext(outputAfter(FaultCause::StuckOn)));
}
/// Appends `off`, which says that the output is off, to the reason `why`, unless `why` already says this or says that
/// the output may still be on.
[[nodiscard]] inline QString withOutput(const QString& why, const QString& off) {
    return saysMayBeOn(why) || why.contains(off) ? why : why + ' ' + off;
}

}  // namespace tacto::gui
