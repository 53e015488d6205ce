#include "app/gui/pilot/ImpedanceTrend.h"

#include <QApplication>
#include <cmath>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/report/ShownText.h"

namespace tacto::gui {

namespace {

constexpr double kMayMove = 0.3;  // allowed relative change from the start; beyond it electrodes must be placed again
constexpr int kPoint_px = 7, kMinPlot = 120;

}  // namespace

ImpedanceTrend::ImpedanceTrend(QWidget* parent)
    : QWidget(parent), title_(new QLabel(this)), now_(new QLabel(this)), plot_(new QCustomPlot(this)) {
    auto* column = columnIn(*this, 4);
    auto* row = new QHBoxLayout;
    row->addWidget(title_);
    row->addStretch();
    row->addWidget(now_);
    column->addLayout(row);
    title_->setText(tr("Impedance, read back in each trial"));
    now_->setObjectName("impedanceNow");
    for (auto* label : {title_, now_}) setTextSize(*label, TextSize::Body, true);
    column->addWidget(plot_, 1);
    plot_->setAccessibleName(tr("Impedance over the session"));
    plot_->setMinimumHeight(kMinPlot);
    plot_->axisRect()->setupFullAxesBox();
    for (auto* axis : {plot_->xAxis2, plot_->yAxis2}) axis->setTicks(false);
    for (auto* axis : {plot_->xAxis, plot_->yAxis}) axis->grid()->setVisible(false);
    plot_->xAxis->setLabel(axisTitle(tr("Trial of the test")));
    plot_->yAxis->setLabel(axisTitle(tr("Impedance"), tr("kΩ")));
    points_ = plot_->addGraph();
    points_->setLineStyle(QCPGraph::lsNone);
    band_ = new QCPItemRect(plot_);
    band_->setLayer("background");
    band_->setPen(Qt::NoPen);
    for (int i = 0; i < 2; ++i) edges_.push_back(new QCPItemLine(plot_));
    bandWord_ = new QCPItemText(plot_);
    bandWord_->position->setTypeX(QCPItemPosition::ptAxisRectRatio);
    bandWord_->setPositionAlignment(Qt::AlignRight | Qt::AlignTop);
    empty_ = new QCPItemText(plot_);
    empty_->position->setType(QCPItemPosition::ptAxisRectRatio);
    empty_->position->setCoords(0.5, 0.5);
    empty_->setText(tr("Each trial of the test adds its reading."));
    watermark_ = addWatermark(*plot_->axisRect());
    addPlotMenu(*plot_, "impedance-of-the-session");
    setPlan(90, 5);
    clear();
    onLookChange(*this, [this] { draw(); });
}

void ImpedanceTrend::clear() {
    ohms_.clear();
    start_ohm_ = 0;
    draw();
}

void ImpedanceTrend::setPlan(int trials, int blocks) {
    if (trials == trials_ && blocks == blocks_) return;
    trials_ = std::max(1, trials);
    blocks_ = std::max(1, blocks);
    for (auto* line : blockLines_) plot_->removeItem(line);
    for (auto* word : blockWords_) plot_->removeItem(word);
    blockLines_.clear();
    blockWords_.clear();
    const double each = double(trials_) / blocks_;
    const auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    for (int block = 0; block <= blocks_; ++block) {
        const int at = int(std::lround(block * each));
        ticker->addTick(at, QString::number(at));
        if (block == blocks_) break;
        if (block > 0) {
            auto* line = new QCPItemLine(plot_);
            for (auto* end : {line->start, line->end}) end->setTypeY(QCPItemPosition::ptAxisRectRatio);
            line->start->setCoords(at, 0);
            line->end->setCoords(at, 1);
            blockLines_.push_back(line);
        }
        auto* word = new QCPItemText(plot_);
        word->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
        word->position->setCoords((block + 0.5) * each, 0.02);
        word->setPositionAlignment(Qt::AlignHCenter | Qt::AlignTop);
        word->setText(tr("block %1").arg(block + 1));
        blockWords_.push_back(word);
    }
    plot_->xAxis->setTicker(ticker);
    plot_->xAxis->setRange(0, trials_);
    draw();
}

void ImpedanceTrend::setSimulated(bool simulated) { showWatermark(*watermark_, simulated); }

void ImpedanceTrend::note(int trial, double ohm) {
    if (!(ohm > 0) || trial < 1) return;
    if (ohms_.empty()) start_ohm_ = ohm;
    auto& kept = ohms_[trial];
    if (kept == ohm) return;
    kept = ohm;
    draw();
}

void ImpedanceTrend::draw() {
    stylePlot(*plot_);
    const auto& c = colours();
    const auto small = textFont(TextSize::Small);
    points_->data()->clear();
    for (const auto& [trial, ohm] : ohms_) points_->addData(trial, ohm / 1000);
    points_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, QPen(c.voltage), QBrush(c.voltage), kPoint_px));
    const bool known = start_ohm_ > 0;
    empty_->setVisible(!known);
    empty_->setColor(c.quiet);
    empty_->setFont(QApplication::font());
    plot_->yAxis->setTickLabels(known);  // before the first reading the axis numbers mean nothing
    plot_->yAxis->setTicks(known);
    const double low = start_ohm_ / 1000 * (1 - kMayMove), high = start_ohm_ / 1000 * (1 + kMayMove);
    band_->setVisible(known);
    bandWord_->setVisible(known);
    band_->setBrush(c.passCell);
    band_->topLeft->setTypeX(QCPItemPosition::ptAxisRectRatio);
    band_->bottomRight->setTypeX(QCPItemPosition::ptAxisRectRatio);
    band_->topLeft->setCoords(0, high);
    band_->bottomRight->setCoords(1, low);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        auto* edge = edges_[i];
        edge->setVisible(known);
        for (auto* end : {edge->start, edge->end}) end->setTypeX(QCPItemPosition::ptAxisRectRatio);
        edge->start->setCoords(0, i == 0 ? low : high);
        edge->end->setCoords(1, i == 0 ? low : high);
        QPen pen(c.passText, 1.5, Qt::CustomDashLine);
        pen.setDashPattern({8 / 1.5, 4 / 1.5});
        edge->setPen(pen);
    }
    bandWord_->position->setCoords(0.99, high);
    bandWord_->setPadding(QMargins(0, 4, 0, 0));
    bandWord_->setText(tr("may move ± 30 % from the start, %1").arg(quantityText(start_ohm_, "ohm", 3)));
    bandWord_->setFont(small);
    bandWord_->setColor(c.text);
    for (auto* line : blockLines_) line->setPen(QPen(c.zero, 1));
    for (auto* word : blockWords_) {
        word->setFont(small);
        word->setColor(c.quiet);
    }
    double least = known ? low : 0.5, most = known ? high : 2;
    for (const auto& [trial, ohm] : ohms_) {
        least = std::min(least, ohm / 1000);
        most = std::max(most, ohm / 1000);
    }
    const double pad = 0.2 * (most - least);
    plot_->yAxis->setRange(std::max(0.0, least - pad), most + 1.4 * pad);
    now_->setText(ohms_.empty() ? tr("not measured yet")
                                : tr("now %1").arg(quantityText(ohms_.rbegin()->second, "ohm", 3)));
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui

#include "moc_ImpedanceTrend.cpp"
