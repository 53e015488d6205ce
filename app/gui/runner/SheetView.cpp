#include "app/gui/runner/SheetView.h"

#include <QPainter>
#include <algorithm>
#include <qcustomplot.h>

#include "app/gui/theme/Text.h"
#include "app/report/SessionReport.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kMinSheetLines = 10;  // height of a readable plot in lines of text

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
    QCPPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF paper(0, 0, size.width() * scale, size.height() * scale);
    painter.fillRect(paper, Qt::white);  // white paper, as in print
    painter.scale(scale, scale);
    sheet_->paint(painter);
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
