#include "app/report/SvgText.h"

#include <QFontMetricsF>
#include <QRegularExpression>
#include <cmath>

#include "app/report/Fonts.h"

namespace tacto {
namespace {

constexpr double kTouching = 1.0;  // px between the end of a text and the beginning of what goes on

double advanceOf(const QString& escaped, double size, int weight) {
    QString text = escaped;
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&");
    return QFontMetricsF(textFont(size, weight >= QFont::Bold)).horizontalAdvance(text);
}

}  // namespace

QString withWholeTexts(const QString& svg) {
    static const QRegularExpression kText(
        R"re(<text ([^>]*?)x="([^"]*)" y="([^"]*)" )re"
        R"re(([^>]*?font-size="([^"]*)" font-weight="([^"]*)"[^>]*)>([^<]*)</text>)re");
    QString out;
    qsizetype taken = 0;
    double end = 0;  // where the text before ends
    QRegularExpressionMatch before;
    for (auto all = kText.globalMatch(svg); all.hasNext();) {
        const auto now = all.next();
        const double x = now.captured(2).toDouble();
        const bool goesOn = before.hasMatch() && svg.mid(taken, now.capturedStart() - taken).trimmed().isEmpty() &&
                            before.captured(1) == now.captured(1) && before.captured(3) == now.captured(3) &&
                            before.captured(4) == now.captured(4) && std::abs(x - end) <= kTouching;
        if (goesOn) {
            out.chop(static_cast<qsizetype>(sizeof "</text>") - 1);
            out += now.captured(7) + "</text>";
        } else {
            out += svg.mid(taken, now.capturedEnd() - taken);
        }
        end = x + advanceOf(now.captured(7), now.captured(5).toDouble(), now.captured(6).toInt());
        taken = now.capturedEnd();
        before = now;
    }
    out += svg.mid(taken);
    // Open Sans and Segoe UI have nearly these widths, Verdana has DejaVu's.
    return out
        .replace("font-family=\"Noto Sans\"",
                 "font-family=\"'Noto Sans','Noto Sans Math','Open Sans','Segoe UI','DejaVu Sans',sans-serif\"")
        .replace("font-family=\"DejaVu Sans\"", "font-family=\"'DejaVu Sans',Verdana,sans-serif\"");
}

}  // namespace tacto
