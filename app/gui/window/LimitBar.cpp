#include "app/gui/window/LimitBar.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <span>

#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kBarWidth = 104;
constexpr int kBarHeight = 8;
constexpr int kBarLineGap = 2;
constexpr double kTie = 1e-9;  // relative; shares this close are equal, and the first row is kept

QString whereJudged(const ExposureRow& row) {
    if (row.quantity == Quantity::NetCharge) return QObject::tr("measured, of the last pulse's phase charge");
    return row.judged == JudgedAt::Ohm500 ? QObject::tr("into 500 Ω") : QObject::tr("worst case over the load range");
}

}  // namespace

std::optional<ExposureRow> tightest(std::span<const ExposureRow> rows, const std::vector<Quantity>& quantities) {
    std::optional<ExposureRow> found;
    const auto share = [](const ExposureRow& row) {
        if (std::isnan(row.limit)) return -1.0;
        return row.evaluated ? row.value / row.limit : 1e9;
    };
    for (const auto& row : rows) {
        if (std::find(quantities.begin(), quantities.end(), row.quantity) == quantities.end()) continue;
        // This limit only says what to print on a label; it restricts nothing.
        if (row.action == LimitAction::Disclose && !std::isnan(row.limit)) continue;
        if (!found || share(row) > share(*found) + kTie * std::abs(share(*found))) found = row;
    }
    return found;
}

LimitBar::LimitBar(const QString& title, QWidget* parent, Shape shape)
    : QWidget(parent), title_(title), shape_(shape), text_("–"), share_(std::nan("")) {
    setAccessibleName(title);
    setToolTip(tr("%1: no output has been set up yet.").arg(title_));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void LimitBar::setTitle(const QString& title) {
    if (std::exchange(title_, title) == title) return;
    setAccessibleName(title);
    update();
}

void LimitBar::show(const std::optional<ExposureRow>& row, std::span<const LimitSet> sets) {
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
        text_ = valueOfLimitText(*row);
    } else {
        text_ = quantityText(row->value, qtext(row->unit), 3);
    }
    set_ = text_;
    beyond_ = row && row->beyond;
    measured_ = row && evaluated_ ? measuredText(*row) : QString();
    if (!measured_.isEmpty()) text_ = tr("%1, %2").arg(set_, measured_);
    if (text_ == before && !(share_ != shareBefore && !std::isnan(share_))) return;
    if (row) {
        const auto name = qtext(titleOf(row->quantity));
        auto tip = tr("%1, %2: %3.").arg(name, whereJudged(*row), text_);
        if (limited_) tip += tr(" Limit of %1.").arg(qtext(titleOf(sets, row->set.view())));
        if (!evaluated_ && !row->reason.empty()) tip += " " + QString::fromUtf8(row->reason.c_str());
        setToolTip(tip);
        setAccessibleDescription(tip);
    }
    update();
}

bool LimitBar::fits() const {
    const QFontMetrics metrics(textFont(TextSize::Small));
    const int title = metrics.horizontalAdvance(title_),
              said = metrics.horizontalAdvance(measured_.isEmpty() ? text_ : shownText());
    return shape_ == Shape::Line ? title + scaledPx(kBarWidth / 8) + said <= width() : std::max(title, said) <= width();
}

QString LimitBar::shownText() const {
    const QFontMetrics metrics(textFont(TextSize::Small));
    const bool line = shape_ == Shape::Line;
    const int room = width() - (line ? metrics.horizontalAdvance(title_) + scaledPx(kBarWidth / 8) : 0);
    for (const auto& text : {text_, beyond_ ? measured_ : set_})
        if (metrics.horizontalAdvance(text) <= room) return text;
    if (line || std::isnan(share_)) return beyond_ ? measured_ : set_;
    return tr("%1 used").arg(quantityText(100 * share_, "%", 2));
}

QSize LimitBar::sizeHint() const {
    const QFontMetrics metrics(textFont(TextSize::Small));
    return {std::max(scaledPx(kBarWidth), metrics.horizontalAdvance("0.82 of 250 mW/cm²")),
            (shape_ == Shape::Line ? 1 : 2) * metrics.height() + scaledPx(kBarHeight) + 2 * kBarLineGap};
}

QSize LimitBar::minimumSizeHint() const {
    const QFontMetrics metrics(textFont(TextSize::Small));
    return {std::max(metrics.horizontalAdvance("RMS over 5 s "), metrics.horizontalAdvance(tr("not evaluated"))),
            sizeHint().height()};
}

void LimitBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto& c = colours();
    painter.setFont(textFont(TextSize::Small));
    const auto metrics = painter.fontMetrics();
    const int line = metrics.height();
    const bool oneLine = shape_ == Shape::Line;
    const QRect top(0, 0, width(), line);
    const QRect bottom(0, height() - line, width(), line);
    const int taken = oneLine ? metrics.horizontalAdvance(shownText()) + scaledPx(kBarWidth / 8) : 0;
    painter.setPen(oneLine ? c.text : c.quiet);
    painter.drawText(top, Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(title_, Qt::ElideRight, width() - taken));
    painter.setPen(beyond_ || (share_ >= 0.8 && oneLine) ? c.amberText : c.text);
    painter.drawText(oneLine ? top : bottom, int((oneLine ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter),
                     metrics.elidedText(shownText(), Qt::ElideRight, width()));
    if (known_ && !limited_ && evaluated_) return;
    const int room = height() - (oneLine ? 1 : 2) * line - 2 * kBarLineGap;
    const QRectF frame(0.5, line + kBarLineGap + 0.5, width() - 1.0, std::max(4, room) - 1.0);
    painter.setPen(QPen(c.line, 1));
    painter.setBrush(c.sunken);
    painter.drawRect(frame);
    if (known_ && !evaluated_) {
        painter.setBrush(QBrush(c.hatch, Qt::BDiagPattern));
        painter.drawRect(frame);
        return;
    }
    if (std::isnan(share_)) return;
    const double filled = std::clamp(share_, 0.0, 1.0);
    painter.setPen(Qt::NoPen);
    painter.setBrush(broken_ ? c.fail : share_ >= 0.8 || beyond_ ? c.amber : c.bar);
    painter.drawRect(QRectF(frame.left(), frame.top(), frame.width() * filled, frame.height()));
}

namespace {
constexpr int kGap = 16;
constexpr double kStaysFor = 0.2;  // lead of the shown bars, as a share of the limit
}  // namespace

LimitBarRow::LimitBarRow(const QStringList& titles, QWidget* parent) : QWidget(parent) {
    for (const auto& title : titles) bars_.push_back(new LimitBar(title, this));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    onEvent(*this, QEvent::Resize, [this] { arrange(); });
}

QSize LimitBarRow::sizeHint() const {
    const auto one = bars_.front()->sizeHint();
    return {int(bars_.size()) * (one.width() + kGap) - kGap, one.height()};
}

int LimitBarRow::oneBarWidth() const { return bars_.front()->minimumSizeHint().width(); }

void LimitBarRow::arrange() {
    const auto one = bars_.front()->sizeHint();
    const auto room = contentsRect();
    auto fit = std::min(bars_.size(), std::size_t((room.width() + kGap) / (one.width() + kGap)));
    if (fit == 0 && room.width() >= oneBarWidth()) fit = 1;
    std::vector<LimitBar*> nearest = bars_;
    // NaN shares (no value yet, or no limit) come last; equal shares stay in the order of the row.
    std::stable_sort(nearest.begin(), nearest.end(), [this](const auto* a, const auto* b) {
        const auto rank = [this](const LimitBar* bar) {
            if (std::isnan(bar->share())) return -1.0;
            return bar->share() + (std::ranges::find(seen_, bar) != seen_.end() ? kStaysFor : 0);
        };
        return rank(a) > rank(b);
    });
    nearest.resize(fit);
    seen_ = nearest;
    const int wide = fit > 0 ? (room.width() + kGap) / int(fit) - kGap : 0;
    int left = room.left();
    for (auto* bar : bars_) {
        const bool seen = std::find(nearest.begin(), nearest.end(), bar) != nearest.end();
        bar->setVisible(seen);
        if (!seen) continue;
        bar->setGeometry(left, (height() - one.height()) / 2, wide, one.height());
        left += wide + kGap;
    }
}

}  // namespace tacto::gui

#include "moc_LimitBar.cpp"
