#include "app/gui/window/LimitBar.h"

#include <QPainter>
#include <span>

#include "app/gui/look/ExposureTable.h"
#include "app/gui/look/Look.h"
#include "app/gui/look/Text.h"

namespace tacto::gui {

namespace {

QString whereJudged(const ExposureRow& row) {
    if (row.quantity == Quantity::NetCharge) return QObject::tr("measured, of the last pulse's phase charge");
    return row.judged == JudgedAt::Ohm500 ? QObject::tr("into 500 Ω") : QObject::tr("worst case over the load range");
}

}  // namespace

std::optional<ExposureRow> tightest(std::span<const ExposureRow> rows, std::initializer_list<Quantity> quantities) {
    std::optional<ExposureRow> found;
    const auto share = [](const ExposureRow& row) {
        if (std::isnan(row.limit)) return -1.0;
        return row.evaluated ? row.value / row.limit : 1e9;
    };
    for (const auto& row : rows) {
        if (std::find(quantities.begin(), quantities.end(), row.quantity) == quantities.end()) continue;
        // Says what to print on a label; nothing is held to it.
        if (row.action == LimitAction::Disclose && !std::isnan(row.limit)) continue;
        if (!found || share(row) > share(*found)) found = row;
    }
    return found;
}

LimitBar::LimitBar(const QString& title, QWidget* parent)
    : QWidget(parent), title_(title), text_("–"), share_(std::nan("")) {
    setAccessibleName(title);
    setToolTip(tr("%1: no output has been set up yet.").arg(title_));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void LimitBar::show(const std::optional<ExposureRow>& row) {
    const auto before = text_;
    const auto shareBefore = share_;
    known_ = row.has_value();
    limited_ = row && !std::isnan(row->limit);
    evaluated_ = row && row->evaluated;
    broken_ = row && row->evaluated && !row->within && row->action == LimitAction::Refuse;
    share_ = limited_ && evaluated_ ? row->value / row->limit : std::nan("");
    if (!row) {
        text_ = "–";
    } else if (!evaluated_) {
        text_ = tr("not evaluated");
    } else if (limited_) {
        text_ = tr("%1 of %2")
                    .arg(quantityText(row->value, qtext(row->unit), 3), settingText(row->limit, qtext(row->unit)));
    } else {
        text_ = quantityText(row->value, qtext(row->unit), 3);
    }
    if (text_ == before && !(share_ != shareBefore && !std::isnan(share_))) return;
    if (row) {
        const auto name = qtext(titleOf(row->quantity));
        auto tip = tr("%1, %2: %3.").arg(name, whereJudged(*row), text_);
        if (limited_) tip += tr(" Limit of %1.").arg(QString::fromUtf8(row->set.c_str()));
        if (!evaluated_ && !row->reason.empty()) tip += " " + QString::fromUtf8(row->reason.c_str());
        setToolTip(tip);
        setAccessibleDescription(tip);
    }
    update();
}

QSize LimitBar::sizeHint() const {
    const auto metrics = fontMetrics();
    return {metrics.horizontalAdvance("88.88 of 188 mA/cm²"), metrics.height() * 5 / 2 + 4};
}

QSize LimitBar::minimumSizeHint() const { return {fontMetrics().horizontalAdvance("5 s RMS "), sizeHint().height()}; }

void LimitBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto& c = colours();
    auto small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    painter.setFont(small);
    const auto metrics = painter.fontMetrics();
    const int line = metrics.height();
    const QRect top(0, 0, width(), line);
    painter.setPen(c.quiet);
    painter.drawText(top, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(title_, Qt::ElideRight, width()));
    const QRect bottom(0, height() - line, width(), line);
    painter.setPen(broken_ ? c.fault : palette().color(QPalette::WindowText));
    painter.drawText(bottom, Qt::AlignLeft | Qt::AlignVCenter, metrics.elidedText(text_, Qt::ElideRight, width()));
    if (known_ && !limited_ && evaluated_) return;
    const int room = height() - 2 * line;
    const QRectF frame(0.5, line + 0.5, width() - 1.0, std::max(4, room) - 1.0);
    painter.setPen(QPen(palette().color(QPalette::Mid), 1));
    painter.setBrush(palette().color(QPalette::Midlight));
    painter.drawRect(frame);
    if (known_ && !evaluated_) {
        painter.setBrush(QBrush(c.quiet, Qt::BDiagPattern));
        painter.drawRect(frame);
        return;
    }
    if (std::isnan(share_)) return;
    const double filled = std::clamp(share_, 0.0, 1.0);
    painter.setPen(Qt::NoPen);
    painter.setBrush(broken_ ? c.fault : share_ >= 0.8 ? c.amber : c.accent);
    painter.drawRect(QRectF(frame.left(), frame.top(), frame.width() * filled, frame.height()));
}

}  // namespace tacto::gui
