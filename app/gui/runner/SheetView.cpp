#include "app/gui/runner/SheetView.h"

#include <QPainter>
#include <algorithm>
#include <qcustomplot.h>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/SessionReport.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kMinSheetLines = 10;  // height of a readable plot in lines of text

/// Turns dark on light into light on dark, between the theme's ground and its text. A colour keeps its hue: only its
/// lightness in HSL is turned over.
void darken(QImage& drawn) {
    const auto ground = colours().base.rgb(), text = colours().text.rgb();
    const auto between = [](int low, int high, int part) { return low + (high - low) * part / 255; };
    for (int y = 0; y < drawn.height(); ++y) {
        auto* line = reinterpret_cast<QRgb*>(drawn.scanLine(y));
        for (int x = 0; x < drawn.width(); ++x) {
            const int r = qRed(line[x]), g = qGreen(line[x]), b = qBlue(line[x]);
            const int turned = 255 - std::max({r, g, b}) - std::min({r, g, b});
            line[x] =
                qRgb(between(qRed(ground), qRed(text), r + turned), between(qGreen(ground), qGreen(text), g + turned),
                     between(qBlue(ground), qBlue(text), b + turned));
        }
    }
}

}  // namespace

void SheetView::show(std::unique_ptr<PlotSheet> sheet) {
    sheet_ = std::move(sheet);
    update();
}

QSize SheetView::minimumSizeHint() const { return {0, fontMetrics().height() * kMinSheetLines}; }

void SheetView::paintEvent(QPaintEvent* /*event*/) {
    if (!sheet_) return;
    const auto size = sheet_->size();
    const double scale = std::min(double(width()) / size.width(), double(height()) / size.height());
    const QSizeF paper(size.width() * scale, size.height() * scale);
    const double ratio = devicePixelRatioF();
    QImage drawn((paper * ratio).toSize(), QImage::Format_RGB32);
    drawn.setDevicePixelRatio(ratio);
    drawn.fill(Qt::white);  // paper, as in print
    {
        QCPPainter painter(&drawn);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.scale(scale, scale);
        sheet_->paint(painter);
    }
    if (currentTheme() == Theme::Dark) darken(drawn);
    QPainter(this).drawImage(QPointF(), drawn);
}

SessionFigure figureIn(const std::vector<SessionRow>& reportItems, const SessionReader& reader) {
    SessionFigure found;
    for (const auto& item : reportItems) {
        if (textOr(item.body, "kind") != "figure") continue;
        const auto drawn = valueOr(item.body, "figure");
        const bool plane = textOr(drawn, "type") == "plane";
        found.planeOfTrials = found.planeOfTrials || plane;
        if (found.figure || plane) continue;
        auto figure = parseFigure(qtObject(drawn));
        if (!figure || !resolveCaptures(*figure, [&](qint64 id) { return reader.capture(id); })) continue;
        found.figure = std::move(*figure);
        found.caption = qtext(textOr(item.body, "caption"));
    }
    return found;
}

SessionFigure readFigure(const std::filesystem::path& path) {
    const auto reader = SessionReader::open(path);
    const auto items = reader ? reader->reportItems() : failure(reader);
    return items ? figureIn(*items, *reader) : SessionFigure();
}

}  // namespace tacto::gui

#include "moc_SheetView.cpp"
