#include "app/gui/calibrate/CalibrationView.h"

#include <algorithm>
#include <cmath>

#include "app/gui/calibrate/CalibrationPlot.h"
#include "app/gui/calibrate/ToleranceCard.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr double kPlotShare = 0.82;  // the plot's share of the height
constexpr int kCardFrom = 104;       // width that a card needs to stand next to others
constexpr int kCardsApart = 8, kCardsBelow = 0;
constexpr int kToolHigh = 24;  // least height of the title line, so that a small window's plot gets the rest

}  // namespace

CalibrationView::CalibrationView(QWidget* parent) : QWidget(parent) {
    setObjectName("calibrationView");
    auto* column = columnIn(*this, kCardsBelow);
    head_ = buildHead();
    column->addWidget(head_);
    plots_ = new PageStack(this);
    errors_ = new CalibrationPlot(CalibrationPlot::Kind::Errors, plots_);
    errors_->setObjectName("calibrationErrors");
    measured_ = new CalibrationPlot(CalibrationPlot::Kind::Measured, plots_);
    measured_->setObjectName("calibrationMeasured");
    addAll(*plots_, {errors_, measured_});
    connect(kind_, &QComboBox::currentIndexChanged, this, [this](int kind) {
        plots_->setCurrentIndex(kind);
        if (shown_ >= 0) say();
    });
    column->addWidget(plots_, 1);
    places_ = new QGridLayout;
    places_->setSpacing(kCardsApart);
    column->addLayout(places_);
    begin({});
    onEvent(*this, QEvent::Resize, [this] { arrange(); });
}

QWidget* CalibrationView::buildHead() {
    auto* head = new QWidget(this);
    auto* row = rowIn(*head);
    title_ = makeLabel<ElidedLabel>({}, {.name = "calibrationShown", .size = TextSize::Body, .strong = true}, head);
    row->addWidget(title_);
    says_ = makeLabel<ElidedLabel>({}, {.name = "calibrationSays"}, head);
    says_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    setTextSize(*says_, TextSize::Small);
    setTone(*says_, Tone::Quiet);
    row->addWidget(says_, 1);
    kind_ = new QComboBox(head);
    nameWidget(*kind_, "calibrationPlotKind", tr("Plot"));
    kind_->addItems({tr("Residuals"), tr("Measured")});
    kind_->setToolTip(
        tr("Residuals: each reading's distance from its command, in the tolerance band. Measured: each "
           "reading against its command, with the fitted line."));
    row->addWidget(kind_);
    addTools(*row);
    kind_->hide();  // hidden until there is a plot
    return head;
}

void CalibrationView::addTools(QBoxLayout& row) {
    auto* pictures = new PictureTools(this);
    pictures->addTo(row);
    pictures->takeFrom([this] { return Still(plot()); }, "calibration");
    connect(pictures, &PictureTools::plotOnlyWanted, this, &CalibrationView::plotOnlyWanted);
    for (auto* tool : pictures->buttons()) {
        const auto fit = [tool] { tool->setFixedHeight(scaledPx(kToolHigh)); };
        onFontChange(*tool, fit);
        fit();
    }
}

QCustomPlot& CalibrationView::plot() const { return *static_cast<QCustomPlot*>(plots_->currentWidget()); }

void CalibrationView::captionPicturesBy(const std::function<PictureCaption()>& caption) {
    for (auto* each : {errors_, measured_}) {
        captionPictures(*each, [this, each, caption] {
            auto whole = caption();
            whole.lines << title_->text() << says_->text() << axesText(*each);
            return whole;
        });
    }
}

void CalibrationView::begin(const nlohmann::json& parameters) {
    parameters_ = parameters;
    all_.clear();
    for (auto* card : cards_) delete card;
    cards_.clear();
    shown_ = -1;
    follow_ = true;
    title_->setText(tr("Residuals in their tolerance"));
    title_->setToolTip(title_->text());
    says_->setText({});
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
    auto* card = new ToleranceCard(quantityTitle(quantity), this);
    cards_.push_back(card);
    const int index = int(cards_.size()) - 1;
    connect(card, &ToleranceCard::clicked, this, [this, index] {
        follow_ = false;
        choose(index);
    });
    if (follow_) shown_ = index;
    arrange();
    tabInPlace(*this);
    return all_.back();
}

void CalibrationView::add(const nlohmann::json& trial) {
    const auto quantity = calibratedQuantity(trial);
    if (quantity.empty()) return;
    auto& readings = of(quantity);
    readings.unit = unitFrom(trial);
    if (const auto at = trial.find("instrument"); at != trial.end() && readings.quantity == "amplitude") {
        const auto step = at->find("resolution");
        if (step != at->end() && step->is_number()) readings.resolution = step->get<double>();
    }
    readings.readings.push_back(readingFrom(trial));
    dirty_ = true;
}

void CalibrationView::draw() {
    if (!std::exchange(dirty_, false) || shown_ < 0) return;
    all_[std::size_t(shown_)].judge();
    choose(shown_);
}

void CalibrationView::end(const nlohmann::json& results) {
    draw();
    for (const auto& [key, found] : results.items()) {
        auto judged = readingsFrom(key, found);
        if (judged) of(key) = std::move(*judged);
    }
    if (const auto rows = valueOr(results, "check"); rows.is_array()) {
        for (auto& one : all_) takeCheck(one, rows);
    }
    if (all_.empty())
        for (auto* plot : {errors_, measured_}) plot->clear(tr("The run ended\nbefore a level was read."));
    else
        choose(follow_ ? nearest() : shown_);
}

/// Returns the index of the quantity that uses most of its tolerance: the verdict's first reason is about it.
int CalibrationView::nearest() const {
    const auto share = [](const CalibrationReadings& one) {
        const auto* use = one.nearest();
        return use != nullptr ? use->share() : 0;
    };
    return int(std::ranges::max_element(all_, {}, share) - all_.begin());
}

void CalibrationView::choose(int index) {
    if (index < 0 || index >= int(all_.size())) return;
    shown_ = index;
    auto& chosen = all_[std::size_t(index)];
    if (!chosen.fit) chosen.judge();
    measured_->show(chosen);
    errors_->show(chosen);
    for (std::size_t i = 0; i < cards_.size(); ++i) cards_[i]->show(all_[i]);
    cards_[std::size_t(index)]->setChecked(true);
    arrange();
    say();
}

void CalibrationView::say() {
    const auto& shown = all_[std::size_t(shown_)];
    const bool residuals = kind_->currentIndex() == 0;
    title_->setText((residuals ? tr("%1: residuals in their tolerance") : tr("%1: measured against commanded"))
                        .arg(quantityTitle(shown.quantity)));
    title_->setToolTip(title_->text());
    const auto marked = std::count_if(shown.readings.begin(), shown.readings.end(),
                                      [](const CalibrationReading& reading) { return reading.outlier; });
    QStringList said;
    if (shown.checks) said << tr("the calibration checked");
    if (shown.fit) {
        said << tr("gain %1").arg(std::isfinite(shown.gainExpanded)
                                      ? quantityText(shown.fit->gain, shown.gainExpanded, {})
                                      : decimalText(shown.fit->gain, 4));
        said << tr("offset %1")
                    .arg(std::isfinite(shown.offsetExpanded)
                             ? quantityText(shown.fit->offset, shown.offsetExpanded, shown.unit)
                             : quantityText(shown.fit->offset, shown.unit, 3));
    }
    said << tr("n = %1").arg(shown.readings.size());
    said << (marked == 0 ? tr("no outliers") : tr("outliers, marked and kept: %1").arg(marked));
    says_->setText(said.join(" · "));
    says_->setToolTip(says_->text());
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
    return shown_ < 0 ? QString() : quantityTitle(all_[std::size_t(shown_)].quantity);
}

/// Places the cards in several rows if one row is too narrow, and makes them low enough for the plot's share.
void CalibrationView::arrange() {
    using Shape = ToleranceCard::Shape;
    if (cards_.empty()) return;
    const int count = int(cards_.size());
    const int columns = std::clamp((width() + kCardsApart) / (scaledPx(kCardFrom) + kCardsApart), 1, count);
    const int rows = (count + columns - 1) / columns;
    const bool placed = places_->count() == count && columns_ == columns;
    columns_ = columns;
    for (int i = 0; i < count && !placed; ++i) places_->addWidget(cards_[std::size_t(i)], i / columns, i % columns);
    shareWidth(columns);
    for (auto* card : cards_) {
        const auto leaves = [&](Shape shape) {
            return height() - head_->sizeHint().height() - rows * card->heightOf(shape) >= kPlotShare * height();
        };
        card->setShape(leaves(Shape::Large)      ? Shape::Large
                       : leaves(Shape::TwoLines) ? Shape::TwoLines
                                                 : Shape::OneLine);
    }
}

/// Shares the width evenly, or by the cards' texts if these do not fit otherwise, so that verdicts keep their word.
void CalibrationView::shareWidth(int columns) {
    const int count = int(cards_.size());
    std::vector<int> wanted(std::size_t(count), 0);
    for (int i = 0; i < count; ++i) {
        auto& column = wanted[std::size_t(i % columns)];
        column = std::max(column, cards_[std::size_t(i)]->wordedWidth());
    }
    const int each = (width() - (columns - 1) * kCardsApart) / columns;
    const bool alike = std::ranges::all_of(wanted, [each](int column) { return column <= each; });
    for (int i = 0; i < count; ++i) {
        const int stretch = i >= columns ? 0 : alike ? 1 : wanted[std::size_t(i)];
        places_->setColumnStretch(i, stretch);
    }
}

void CalibrationView::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    kind_->show();
}

void CalibrationView::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    if (!isAncestorOf(kind_)) kind_->hide();
}

}  // namespace tacto::gui

#include "moc_CalibrationView.cpp"
