#include "app/gui/calibrate/CalibrationView.h"

#include <QVBoxLayout>

#include "app/gui/calibrate/CalibrationPlot.h"
#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr int kBesideChars = 76;  // two plots stand side by side from this width on
constexpr int kBelowLines = 26;   // one above the other from this height on; else the errors alone

}  // namespace

CalibrationView::CalibrationView(QWidget* parent) : QWidget(parent) {
    setObjectName("calibrationView");
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    tabs_ = new QTabBar(this);
    tabs_->setObjectName("quantities");
    tabs_->setAccessibleName(tr("Calibrated quantity"));
    tabs_->setToolTip(
        tr("The quantities that are calibrated, one after the other. The plots follow the run until you "
           "choose one."));
    tabs_->setExpanding(false);
    tabs_->setDrawBase(false);
    connect(tabs_, &QTabBar::currentChanged, this, &CalibrationView::choose);
    column->addWidget(tabs_);
    says_ = new QLabel(this);
    says_->setObjectName("calibrationSays");
    says_->setWordWrap(true);
    says_->setForegroundRole(QPalette::PlaceholderText);
    column->addWidget(says_);
    plots_ = new QBoxLayout(QBoxLayout::LeftToRight);
    measured_ = new CalibrationPlot(CalibrationPlot::Kind::Measured, this);
    measured_->setObjectName("calibrationMeasured");
    errors_ = new CalibrationPlot(CalibrationPlot::Kind::Errors, this);
    errors_->setObjectName("calibrationErrors");
    plots_->addWidget(measured_, 2);
    plots_->addWidget(errors_, 3);
    column->addLayout(plots_, 1);
    begin({});
}

void CalibrationView::begin(const nlohmann::json& parameters) {
    parameters_ = parameters;
    all_.clear();
    follow_ = true;
    following_ = true;
    while (tabs_->count() > 0) tabs_->removeTab(0);
    following_ = false;
    tabs_->hide();
    says_->hide();
    measured_->clear();
    errors_->clear();
}

CalibrationReadings& CalibrationView::of(const std::string& quantity) {
    for (auto& one : all_) {
        if (one.quantity == quantity) return one;
    }
    CalibrationReadings made;
    made.quantity = quantity;
    made.tolerance_pct = toleranceOf(quantity, parameters_);
    all_.push_back(made);
    following_ = true;
    tabs_->addTab(quantityTitle(quantity));
    if (follow_) tabs_->setCurrentIndex(tabs_->count() - 1);
    following_ = false;
    tabs_->show();
    return all_.back();
}

void CalibrationView::add(const nlohmann::json& trial) {
    if (!isReading(trial)) return;
    auto& readings = of(calibratedQuantity(trial));
    readings.unit = unitFrom(trial);
    if (const auto at = trial.find("instrument"); at != trial.end() && readings.quantity == "amplitude") {
        const auto step = at->find("resolution");
        if (step != at->end() && step->is_number()) readings.resolution = step->get<double>();
    }
    readings.readings.push_back(readingFrom(trial));
    dirty_ = true;
}

void CalibrationView::draw() {
    if (!std::exchange(dirty_, false)) return;
    const int shown = tabs_->currentIndex();
    if (shown < 0) return;
    all_[std::size_t(shown)].judge();
    choose(shown);
}

void CalibrationView::end(const nlohmann::json& results) {
    draw();
    if (!results.is_object()) return;
    for (const auto& [key, found] : results.items()) {
        auto judged = readingsFrom(key, found);
        if (judged) of(key) = std::move(*judged);
    }
    if (!all_.empty()) {
        following_ = true;
        if (follow_) tabs_->setCurrentIndex(0);
        following_ = false;
        choose(tabs_->currentIndex());
    }
}

void CalibrationView::choose(int index) {
    if (index < 0 || index >= int(all_.size())) return;
    if (!following_ && sender() == tabs_) follow_ = false;
    auto& chosen = all_[std::size_t(index)];
    if (!chosen.fit) chosen.judge();
    measured_->show(chosen);
    errors_->show(chosen);
    say();
}

void CalibrationView::say() {
    const auto& shown = all_[std::size_t(tabs_->currentIndex())];
    const auto marked = std::count_if(shown.readings.begin(), shown.readings.end(),
                                      [](const CalibrationReading& reading) { return reading.outlier; });
    QStringList said{tr("n = %1").arg(shown.readings.size())};
    if (shown.fit) {
        said << tr("gain %1").arg(shown.fit->gain, 0, 'f', 4);
        said << tr("offset %1").arg(quantityText(shown.fit->offset, shown.unit, 3));
    }
    said << (marked == 0 ? tr("none stands out") : tr("standing out, marked and kept: %1").arg(marked));
    says_->setText(said.join(" · "));
    says_->show();
}

void CalibrationView::setSimulated(bool simulated) {
    measured_->setSimulated(simulated);
    errors_->setSimulated(simulated);
}

std::size_t CalibrationView::readings() const {
    std::size_t count = 0;
    for (const auto& one : all_) count += one.readings.size();
    return count;
}

QString CalibrationView::quantityShown() const {
    return tabs_->currentIndex() < 0 ? QString() : tabs_->tabText(tabs_->currentIndex());
}

void CalibrationView::arrange() {
    const bool beside = width() >= fontMetrics().averageCharWidth() * kBesideChars;
    const bool below = height() >= fontMetrics().height() * kBelowLines;
    plots_->setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    measured_->setVisible(beside || below);
}

void CalibrationView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

}  // namespace tacto::gui
