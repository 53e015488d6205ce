#include "app/gui/calibrate/CalibrationTrendView.h"

#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kLaneTicks = 3;
constexpr double kPad = 0.15;  // margin above and below, as a share of a lane's span
constexpr double kDay_s = 86400;
constexpr int kDayPadding = 12;  // least margin in days before and after the calibrations
constexpr int kMaxJumps = 2;     // most jumps described in words; the plot marks all
constexpr int kMinLines = 16;

double secondsOf(CalibrationDate day) {
    return std::chrono::duration<double>(std::chrono::sys_days(day).time_since_epoch()).count();
}

QString dayText(CalibrationDate day) { return qtext(dateText(day)); }

QString signedText(const QString& text, double value) { return value > 0 ? "+" + text : text; }

}  // namespace

CalibrationTrendView::CalibrationTrendView(QWidget* parent)
    : QWidget(parent),
      says_(makeLabel({}, {.name = "trendSays", .wraps = true}, this)),
      warns_(makeLabel({}, {.name = "trendWarns", .wraps = true}, this)),
      quantity_(new QComboBox(this)),
      plot_(new QCustomPlot(this)) {
    setObjectName("calibrationTrend");
    auto* column = columnIn(*this);
    auto* row = new QHBoxLayout;
    row->addWidget(says_, 1);
    nameWidget(*quantity_, "trendQuantity", tr("Quantity of the trend"), tr("What gain, offset and U are of."));
    quantity_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    row->addWidget(quantity_);
    column->addLayout(row);
    column->addWidget(warns_);
    buildPlot();
    column->addWidget(plot_, 1);
    connect(quantity_, &QComboBox::currentIndexChanged, this, &CalibrationTrendView::draw);
    onLookChange(*this, [this] {
        colour();
        plot_->replot(QCustomPlot::rpQueuedReplot);
    });
}

void CalibrationTrendView::buildPlot() {
    nameWidget(
        *plot_, "trendPlot", tr("Trend of the calibration"),
        tr("Each stored calibration, with its U (95 %): of the gain as it is, of the offset at the lowest command that "
           "was calibrated. A thick line joins two that differ by more than both U explain."));
    plot_->setMinimumHeight(fontMetrics().height() * kMinLines);
    plot_->plotLayout()->clear();
    plot_->plotLayout()->setRowSpacing(4);
    auto* margins = new QCPMarginGroup(plot_);
    for (int i = 0; i < kLanes; ++i) {
        lanes_[std::size_t(i)] = makeLane(i, i + 1 == kLanes);
        lanes_[std::size_t(i)].axes->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
    }
    auto* top = lanes_[kGainLane].axes;
    for (auto** word : {&dueWord_, &todayWord_}) {
        *word = new QCPItemText(plot_);
        (*word)->setClipToAxisRect(false);
        (*word)->position->setAxes(top->axis(QCPAxis::atBottom), top->axis(QCPAxis::atLeft));
        (*word)->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
        (*word)->position->setAxisRect(top);
        (*word)->setPositionAlignment(Qt::AlignHCenter | Qt::AlignBottom);
    }
    watermark_ = addWatermark(*lanes_[kOffsetLane].axes);
    addPlotMenu(*plot_, "calibration-trend");
}

CalibrationTrendView::Lane CalibrationTrendView::makeLane(int row, bool last) {
    Lane lane;
    lane.axes = new QCPAxisRect(plot_);
    plot_->plotLayout()->addElement(row, 0, lane.axes);
    auto* x = lane.axes->axis(QCPAxis::atBottom);
    auto* y = lane.axes->axis(QCPAxis::atLeft);
    for (auto* axis : lane.axes->axes()) axis->setLayer("axes");
    for (auto* axis : {x, y}) axis->grid()->setLayer("grid");
    lane.axes->setupFullAxesBox();
    for (auto* axis : {lane.axes->axis(QCPAxis::atTop), lane.axes->axis(QCPAxis::atRight)}) axis->setTicks(false);
    const auto days = QSharedPointer<QCPAxisTickerDateTime>::create();
    days->setDateTimeFormat("yyyy-MM-dd");
    days->setDateTimeSpec(Qt::UTC);
    x->setTicker(days);
    x->setTickLabels(last);
    y->setTicker(QSharedPointer<PlainTicker>::create(kLaneTicks));
    if (row == kGainLane) lane.axes->setMinimumMargins(QMargins(0, int(fontMetrics().height() * 1.4), 0, 0));
    lane.jumps = plot_->addGraph(x, y);  // below the points
    lane.line = plot_->addGraph(x, y);
    lane.bars = new QCPErrorBars(x, y);
    lane.bars->setDataPlottable(lane.line);
    lane.bars->setErrorType(QCPErrorBars::etValueError);
    for (auto** mark : {&lane.due, &lane.today}) {
        *mark = new QCPItemLine(plot_);
        (*mark)->setClipAxisRect(lane.axes);
        for (auto* end : {(*mark)->start, (*mark)->end}) {
            end->setAxes(x, y);
            end->setAxisRect(lane.axes);
            end->setTypeY(QCPItemPosition::ptAxisRectRatio);
        }
    }
    return lane;
}

void CalibrationTrendView::show(std::vector<StoredCalibration> stored) {
    stored_ = std::move(stored);
    fillChooser();
    draw();
}

/// Each calibrated unit has its own quantities; those of the newest calibration come first.
void CalibrationTrendView::fillChooser() {
    const auto before = quantity_->currentData();
    const QSignalBlocker quiet(quantity_);
    quantity_->clear();
    QStringList units;
    for (auto one = stored_.rbegin(); one != stored_.rend(); ++one) {
        if (const auto name = qtext(one->unit); !units.contains(name)) units << name;
    }
    const auto add = [&](const QString& title, const QString& ofUnit, std::string_view key) {
        quantity_->addItem(units.size() > 1 ? tr("%1 (source in %2)").arg(title, ofUnit) : title,
                           QStringList{ofUnit, qtext(key)});
    };
    for (const auto& one : units) {
        add(tr("Amplitude"), one, "amplitude");
        for (const auto& time : kStoredTimes) add(qtext(time.title), one, time.id);
    }
    quantity_->setCurrentIndex(std::max(0, quantity_->findData(before)));
    if (quantity_->count() == 0) quantity_->setCurrentIndex(-1);
}

QString CalibrationTrendView::unit() const {
    const auto chosen = quantity_->currentData().toStringList();
    return chosen.value(1) == "amplitude" ? chosen.value(0) : QString("s");
}

void CalibrationTrendView::draw() {
    const auto chosen = quantity_->currentData().toStringList();
    points_.clear();
    const auto ofUnit = chosen.value(0).toStdString();
    const auto newest = std::find_if(stored_.rbegin(), stored_.rend(),
                                     [&](const StoredCalibration& one) { return one.unit == ofUnit; });
    if (newest != stored_.rend()) {
        points_ = trendOf(stored_, ofUnit, newest->simulated, chosen.value(1).toStdString());
        due_ = newest->validUntil;
        watermark_->setVisible(newest->simulated);
    }
    const auto jumps = jumpsIn(points_);
    says_->setText(dueText());
    warns_->setText(jumpText(jumps));
    setTone(*warns_, jumps.empty() ? Tone::Quiet : Tone::Warning);
    warns_->setVisible(!points_.empty());
    plot_->setVisible(!points_.empty());
    if (points_.empty()) return;
    for (int i = 0; i < kLanes; ++i) drawLane(LaneOf(i), jumps);
    drawDays();
    colour();
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void CalibrationTrendView::drawLane(LaneOf which, const std::vector<TrendJump>& jumps) {
    const auto valueOf = [&](const TrendPoint& point) {
        return which == kGainLane ? point.gain : which == kOffsetLane ? point.offset : point.uncertainty_pct;
    };
    const auto barOf = [&](const TrendPoint& point) {
        return which == kGainLane ? point.gainU : which == kOffsetLane ? point.offsetU : std::nan("");
    };
    double low = INFINITY, high = -INFINITY;
    for (const auto& point : points_) {
        if (!std::isfinite(valueOf(point))) continue;
        const double bar = std::isfinite(barOf(point)) ? barOf(point) : 0;
        low = std::min(low, valueOf(point) - bar);
        high = std::max(high, valueOf(point) + bar);
    }
    if (which == kULane) low = 0;  // for U the axis starts at 0, the ideal value
    const bool known = low <= high;
    const auto axis = which == kOffsetLane ? axisUnit(known ? std::max(std::abs(low), std::abs(high)) : 1, unit())
                      : which == kULane    ? AxisUnit{1, "%"}
                                           : AxisUnit{1, {}};
    auto& lane = lanes_[std::size_t(which)];
    lane.line->data()->clear();
    lane.jumps->data()->clear();
    QVector<double> bars;
    for (const auto& point : points_) {
        if (!std::isfinite(valueOf(point))) continue;
        lane.line->addData(secondsOf(point.made), valueOf(point) * axis.factor);
        bars << (std::isfinite(barOf(point)) ? barOf(point) * axis.factor : 0);
    }
    lane.bars->setData(bars);
    const auto wanted = which == kGainLane ? TrendJump::What::Gain : TrendJump::What::Offset;
    for (std::size_t i = 1; which != kULane && i < points_.size(); ++i) {
        const auto& a = points_[i - 1];
        const auto& b = points_[i];
        const bool jumped = std::ranges::any_of(jumps, [&](const TrendJump& jump) {
            return jump.what == wanted && jump.from == a.made && jump.to == b.made;
        });
        if (!jumped) continue;
        lane.jumps->addData(secondsOf(a.made), valueOf(a) * axis.factor);
        lane.jumps->addData(secondsOf(b.made), valueOf(b) * axis.factor);
        lane.jumps->addData((secondsOf(b.made)) + 1, std::nan(""));  // a gap before the next jump
    }
    const double span = known && high > low ? high - low : known && low != 0 ? std::abs(low) * 0.1 : 1;
    const double from = known ? low - (which == kULane ? 0 : kPad * span) : 0;
    lane.axes->axis(QCPAxis::atLeft)->setRange(from * axis.factor, ((known ? high : 1) + kPad * span) * axis.factor);
    const QString labels[kLanes] = {tr("Gain"), axisTitle(tr("Offset"), axis.unit), axisTitle(tr("U"), "%")};
    lane.axes->axis(QCPAxis::atLeft)->setLabel(labels[which]);
}

/// Draws one axis of days for all lanes: from the first calibration to the newest one's due date, or to today.
void CalibrationTrendView::drawDays() {
    const double first = secondsOf(points_.front().made), due = secondsOf(due_), now = secondsOf(utcToday());
    const double last = std::max({due, now, secondsOf(points_.back().made)});
    const double pad = std::max((last - first) * 0.06, kDayPadding * kDay_s);
    for (auto& lane : lanes_) {
        lane.axes->axis(QCPAxis::atBottom)->setRange(first - pad, last + pad);
        lane.due->start->setCoords(due, 0);
        lane.due->end->setCoords(due, 1);
        lane.today->start->setCoords(now, 0);
        lane.today->end->setCoords(now, 1);
    }
    dueWord_->setText(tr("due %1").arg(dayText(due_)));
    todayWord_->setText(tr("today"));
    dueWord_->position->setCoords(due, -0.04);
    todayWord_->position->setCoords(now, -0.04);
    // If both words would overlap, only the due date is shown.
    const double perWord = (last - first + 2 * pad) * 0.16;
    todayWord_->setVisible(std::abs(due - now) > perWord);
}

QString CalibrationTrendView::dueText() const {
    if (points_.empty()) return {};
    const int left = daysBetween(utcToday(), due_);
    const auto days = [](int count) { return count == 1 ? tr("1 day") : tr("%1 days").arg(count); };
    if (left < 0) return tr("The calibration was due on %1, %2 ago. Calibrate again.").arg(dayText(due_), days(-left));
    return left == 0 ? tr("The next calibration is due today, %1.").arg(dayText(due_))
                     : tr("The next calibration is due on %1, in %2.").arg(dayText(due_), days(left));
}

QString CalibrationTrendView::jumpText(const std::vector<TrendJump>& jumps) const {
    if (points_.size() < 2) return tr("One calibration so far. A trend shows from the second one on.");
    if (jumps.empty()) {
        const bool judged = std::ranges::all_of(points_, [](const TrendPoint& p) { return std::isfinite(p.gainU); });
        return judged ? tr("No change from one to the next is larger than both U explain.")
                      : tr("Changes are not judged where U is not stated.");
    }
    QStringList all;
    for (auto jump = jumps.rbegin(); jump != jumps.rend() && all.size() < kMaxJumps; ++jump) {
        const bool gain = jump->what == TrendJump::What::Gain;
        const auto text = [&](double value) {
            return gain ? quantityText(100 * value, "%", 2) : quantityText(value, unit(), 2);
        };
        all << tr("⚠ Between %1 and %2 the %3 moved by %4; both U together explain %5.")
                   .arg(dayText(jump->from), dayText(jump->to), gain ? tr("gain") : tr("offset"),
                        signedText(text(jump->change), jump->change), text(jump->explained));
    }
    if (int(jumps.size()) > kMaxJumps) all << tr("Earlier ones are marked in the plot.");
    return all.join(" ") + tr(" Find the cause before you rely on it.");
}

void CalibrationTrendView::colour() {
    stylePlot(*plot_);
    const auto& c = colours();
    const double size = QFontMetricsF(QApplication::font()).height() / 2.6;
    const bool overdue = due_ < utcToday();
    for (auto& lane : lanes_) {
        lane.line->setPen(QPen(c.quiet, 1));
        lane.line->setScatterStyle({QCPScatterStyle::ssDisc, QPen(c.text, 1), QBrush(c.text), size});
        lane.jumps->setPen(QPen(c.amber, scaledPx(3)));
        lane.bars->setPen(QPen(c.text, 1));
        lane.due->setPen(QPen(overdue ? c.amberText : c.text, 1.5, Qt::CustomDashLine));
        auto pen = lane.due->pen();
        pen.setDashPattern({6, 3});
        lane.due->setPen(pen);
        lane.today->setPen(QPen(c.zero, 1));
    }
    dueWord_->setColor(overdue ? c.amberText : c.text);
    todayWord_->setColor(c.quiet);
    for (auto* word : {dueWord_, todayWord_}) word->setFont(textFont(TextSize::Small));
}

}  // namespace tacto::gui

#include "moc_CalibrationTrendView.cpp"
