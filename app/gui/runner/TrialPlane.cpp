#include "app/gui/runner/TrialPlane.h"

#include "app/gui/theme/PlotLegend.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kPoint = 8;  // point size in pixels
// With these rows, title and frame are as far apart as in a CaptureStrip, which has an empty legend line there.
constexpr int kBetweenRows = 1, kAboveFrame = 3, kAroundFrame = 15;

}  // namespace

TrialPlane::TrialPlane(QWidget* parent) : QCustomPlot(parent) {
    setAccessibleName(tr("Trials"));
    for (auto* axis : {xAxis, yAxis}) axis->setNumberFormat("gb");
    putLegendAbove(*this);
    wrapLegend(*this);
    addPlotMenu(*this, "trials");
    watermark_ = addWatermark(*axisRect());
    empty_ = new QCPItemText(this);
    empty_->position->setType(QCPItemPosition::ptAxisRectRatio);
    empty_->position->setCoords(0.5, 0.5);
    setMinimumHeight(fontMetrics().height() * 12);
    connect(this, &QCustomPlot::afterLayout, this, &TrialPlane::nameClusters);
    begin(false);
    onLookChange(*this, [this] {
        colour();
        replot(QCustomPlot::rpQueuedReplot);
    });
}

void TrialPlane::addTitle() {
    plotLayout()->insertRow(0);
    title_ = new QCPTextElement(this);
    title_->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    plotLayout()->addElement(0, 0, title_);
    plotLayout()->setRowSpacing(kBetweenRows);
    axisRect()->setMinimumMargins(QMargins(kAroundFrame, kAboveFrame, kAroundFrame, kAroundFrame));
    colour();
    sayTitle();
}

void TrialPlane::sayTitle() {
    if (title_ == nullptr) return;
    const auto what = features_ == Features::Trains ? tr("Trials in the plane") : tr("Slides over the surfaces");
    title_->setText(drawn_ == 0 ? what : QString("%1, %2").arg(what).arg(drawn_));
}

void TrialPlane::begin(bool simulated, Features features) {
    features_ = features;
    const bool trains = features == Features::Trains;
    setToolTip(trains ? tr("One point per trial: amplitude and interval as measured by the oscilloscope.")
                      : tr("One point per slide: what the fingertip felt of the surface. R is made of both."));
    xAxis->setLabel(trains ? tr("Interval (s)") : tr("Taxel feature v"));
    yAxis->setLabel(trains ? tr("Amplitude (V)") : tr("Vibration feature h"));
    empty_->setText(trains ? tr("Trials appear here\nwhile the protocol runs.")
                           : tr("Slides over the surfaces\nappear here."));
    for (const auto& [name, graph] : conditions_) removePlottable(graph);
    conditions_.clear();
    for (auto* name : names_) removeItem(name);
    names_.clear();
    trials_ = drawn_ = 0;
    sayTitle();
    watermark_->setVisible(simulated);
    empty_->setVisible(true);
    legend->setVisible(false);
    fit();
    colour();
    replot(QCustomPlot::rpQueuedReplot);
}

void TrialPlane::end() {
    if (drawn_ > 0) return;
    const bool trains = features_ == Features::Trains;
    empty_->setText(trials_ == 0 ? tr("The run ended\nbefore its first trial.")
                    : trains     ? tr("No trial of this run has\nboth amplitude and interval.")
                                 : tr("No slide of this run\nwas measured."));
    replot(QCustomPlot::rpQueuedReplot);
}

void TrialPlane::add(const nlohmann::json& trial) {
    ++trials_;
    const auto number = [&](const char* key) {
        const auto at = trial.find(key);
        return at != trial.end() && at->is_number() ? at->get<double>() : std::nan("");
    };
    const bool trains = features_ == Features::Trains;
    const double y = number(trains ? "amplitude_v" : "h");
    double x = number(trains ? "interval_s" : "v_static");
    if (!std::isfinite(y) || (trains && !std::isfinite(x))) return;
    ++drawn_;
    sayTitle();
    if (!std::isfinite(x)) {
        x = drawn_;
        xAxis->setLabel(tr("Slide"));
    }
    const auto name = QString::fromStdString(trial.value("condition", std::string()));
    auto found = std::find_if(conditions_.begin(), conditions_.end(), [&](const auto& c) { return c.first == name; });
    if (found == conditions_.end()) {
        auto* graph = addGraph();
        graph->setName(name);
        graph->setLineStyle(QCPGraph::lsNone);
        conditions_.emplace_back(name, graph);
        found = std::prev(conditions_.end());
        auto* words = new QCPItemText(this);
        words->setText(name);
        words->setPositionAlignment(Qt::AlignLeft | Qt::AlignTop);
        words->position->setType(QCPItemPosition::ptAbsolute);
        words->setPadding({});
        names_.push_back(words);
        empty_->setVisible(false);
        colour();
    }
    found->second->addData(x, y);
    fit();
    replot(QCustomPlot::rpQueuedReplot);
}

void TrialPlane::fit() {
    // Trains always show the encoder's whole range; slides have no fixed range.
    const bool trains = features_ == Features::Trains;
    QCPRange x(0, trains ? 2.2 : 0), y(0, trains ? 44 : 0);
    for (const auto& [name, graph] : conditions_) {
        bool found = false;
        const auto keys = graph->getKeyRange(found);
        if (found) x.expand(QCPRange(0, keys.upper * 1.1));
        const auto values = graph->getValueRange(found);
        if (found) y.expand(QCPRange(0, values.upper * 1.1));
    }
    xAxis->setRange(x.upper > 0 ? x : QCPRange(0, 1));
    yAxis->setRange(y.upper > 0 ? y : QCPRange(0, 1));
}

void TrialPlane::colour() {
    stylePlot(*this);
    const auto& c = colours();
    empty_->setColor(c.quiet);
    if (title_ != nullptr) {
        title_->setFont(textFont(TextSize::Small, QFont::DemiBold));
        title_->setTextColor(c.text);
    }
    fitLegend(*this);
    int index = 0;
    for (const auto& [name, graph] : conditions_) {
        const auto style = conditionInTheme(name, index++);
        graph->setPen(QPen(style.color));
        graph->setScatterStyle(QCPScatterStyle(style.marker, QPen(style.color, 1.5), QBrush(Qt::NoBrush), kPoint));
    }
}

QRectF TrialPlane::pixelsOf(const QCPGraph& graph) const {
    QRectF box;
    for (const auto& point : *graph.data()) {
        QRectF its(0, 0, kPoint, kPoint);
        its.moveCenter(QPointF(xAxis->coordToPixel(point.key), yAxis->coordToPixel(point.value)));
        box |= its;
    }
    return box;
}

std::optional<QRectF> TrialPlane::placeOf(const QSizeF& name, std::size_t cluster,
                                          const std::vector<QRectF>& taken) const {
    const auto points = pixelsOf(*conditions_[cluster].second);
    const QRectF area(axisRect()->rect());
    QRectF box(QPointF(), name);
    const double across = points.center().x() - name.width() / 2, up = points.center().y() - name.height() / 2;
    const double within = std::clamp(across, area.left() + kPoint, area.right() - name.width() - kPoint);
    for (const auto& at :
         {QPointF(within, points.top() - name.height() - kPoint / 2), QPointF(within, points.bottom() + kPoint / 2),
          QPointF(points.right() + kPoint, up), QPointF(points.left() - name.width() - kPoint, up)}) {
        box.moveTopLeft(at);
        if (!area.contains(box)) continue;
        if (std::none_of(taken.begin(), taken.end(), [&](const QRectF& its) { return its.intersects(box); }))
            return box;
    }
    return std::nullopt;
}

void TrialPlane::nameClusters() {
    const auto font = textFont(TextSize::Small, QFont::DemiBold);
    const QFontMetricsF metrics(font);
    std::vector<QRectF> taken;
    for (const auto& [name, graph] : conditions_) taken.push_back(pixelsOf(*graph));
    bool all = true;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const QSizeF size(metrics.horizontalAdvance(conditions_[i].first) + 2, metrics.height());
        const auto place = placeOf(size, i, taken);
        all = all && place;
        if (!place) continue;
        names_[i]->position->setPixelPosition(place->topLeft());
        taken.push_back(*place);
    }
    for (auto* name : names_) {
        name->setFont(font);
        name->setColor(colours().text);
        name->setVisible(all);
    }
    if (legend->visible() == (!all && !conditions_.empty())) return;
    legend->setVisible(!all && !conditions_.empty());
    fitLegend(*this);
    replot(QCustomPlot::rpQueuedReplot);  // the number of rows to draw has changed
}

}  // namespace tacto::gui

#include "moc_TrialPlane.cpp"
