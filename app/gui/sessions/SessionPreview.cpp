#include "app/gui/sessions/SessionPreview.h"

#include <algorithm>

#include "app/gui/runner/SheetView.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/PlotLegend.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/report/FigureDrawing.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kCurvePoints = 4000;
constexpr int kMinLines = 10;  // height of a readable plot in lines of text

bool inThePlane(const SessionTrial& trial) {
    return std::isfinite(numberOr(trial.measured, "amplitude_v")) &&
           std::isfinite(numberOr(trial.measured, "interval_s"));
}

}  // namespace

QCPGraph* addCurve(QCustomPlot& plot, QCPAxis* values, const std::vector<double>& t, const std::vector<double>& y,
                   const QString& name) {
    auto* graph = plot.addGraph(plot.xAxis, values);
    graph->setName(name);
    QVector<double> x, shown;
    for (const auto i : visiblePoints(y, kCurvePoints)) {
        x << t[i];
        shown << y[i];
    }
    graph->setData(x, shown, true);
    return graph;
}

SessionPreview::SessionPreview(QWidget* parent)
    : QWidget(parent),
      title_(makeLabel({}, {.name = "previewTitle", .size = TextSize::Small, .strong = true, .wraps = true}, this)),
      stack_(new QStackedWidget(this)) {
    auto* column = columnIn(*this, 4);
    column->addWidget(title_);
    column->addWidget(stack_, 1);
    nothing_ = makeLabel({}, {.name = "nothingToDraw"}, stack_);
    nothing_->setAlignment(Qt::AlignCenter);
    nothing_->setWordWrap(true);
    setTone(*nothing_, Tone::Quiet);
    plane_ = new TrialPlane(stack_);
    sheet_ = new SheetView(stack_);
    course_ = new QCustomPlot(stack_);
    nameWidget(*course_, "course", tr("What was felt and delivered"));
    course_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    course_->axisRect()->setRangeZoom(Qt::Horizontal);
    course_->axisRect()->setRangeDrag(Qt::Horizontal);
    putLegendAbove(*course_);
    addPlotMenu(*course_, "session");
    watermark_ = addWatermark(*course_->axisRect());
    marks_ = std::make_unique<MarkLines>(*course_);
    // After a drag or zoom, each mark's word moves with its time.
    connect(course_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &SessionPreview::drawMarks);
    for (auto* page : std::initializer_list<QWidget*>{nothing_, plane_, sheet_, course_}) stack_->addWidget(page);
    clear();
    onLookChange(*this, [this] { colour(); });
    const auto least = [this] {
        for (auto* plot : std::initializer_list<QCustomPlot*>{plane_, course_})
            plot->setMinimumHeight(fontMetrics().height() * kMinLines);
    };
    least();
    onFontChange(*this, least);
}

void SessionPreview::clear() {
    title_->clear();
    nothing_->clear();
    stack_->setCurrentWidget(nothing_);
}

void SessionPreview::show(const ReadSession& session) {
    const auto drawn = std::ranges::count_if(session.trials, inThePlane);
    if (drawn > 0 && (session.planeOfTrials || !session.figure)) {
        plane_->begin(session.about.simulated);
        for (const auto& trial : session.trials) {
            auto measured = trial.measured;
            measured["condition"] = trial.condition;
            plane_->add(measured);
        }
        title_->setText(tr("Trials in the plane, %1 of %2").arg(drawn).arg(session.trials.size()));
        return stack_->setCurrentWidget(plane_);
    }
    if (session.figure) {
        sheet_->show(drawFigure(*session.figure, session.about.simulated));
        title_->setText(session.caption.isEmpty() ? tr("First figure of the report") : session.caption);
        return stack_->setCurrentWidget(sheet_);
    }
    if (!session.course.empty()) {
        drawCourse(session);
        const auto& course = session.course;
        auto title = course.train_s.empty() ? tr("What the fingertip felt")
                                            : tr("What was felt, and the trains that were delivered");
        if (course.oneIn > 1) title += tr("; of %1 stretches of what was felt, one is drawn").arg(course.oneIn);
        if (course.perTrain > 1) title += tr("; of %1 trains, the largest is drawn").arg(course.perTrain);
        title_->setText(title);
        return stack_->setCurrentWidget(course_);
    }
    title_->clear();
    nothing_->setText(tr("Nothing to draw: this session holds no trial, no figure, no train and no touch."));
    stack_->setCurrentWidget(nothing_);
}

void SessionPreview::drawCourse(const ReadSession& session) {
    const auto& course = session.course;
    course_->clearGraphs();
    watermark_->setVisible(session.about.simulated);
    course_->xAxis->setLabel(tr("Time (s)"));
    const bool felt = !course.frame_s.empty();
    const bool delivered = !course.train_s.empty();
    auto* amplitudes = felt ? course_->yAxis2 : course_->yAxis;
    if (felt) {
        addCurve(*course_, course_->yAxis, course.frame_s, course.roughness, tr("R"));
        addCurve(*course_, course_->yAxis, course.frame_s, course.pressure, tr("P"));
        course_->yAxis->setLabel(tr("R and P"));
    }
    if (delivered) {
        addCurve(*course_, amplitudes, course.train_s, course.amplitude, tr("amplitude"));
        course_->graph(course_->graphCount() - 1)->setLineStyle(QCPGraph::lsImpulse);
        amplitudes->setLabel(tr("Amplitude (%1)").arg(course.unit));
    }
    course_->yAxis2->setVisible(felt && delivered);
    course_->legend->setVisible(course_->graphCount() > 1);
    course_->rescaleAxes();
    if (felt) course_->yAxis->setRange(-0.05, 1.05);
    if (delivered) amplitudes->setRange(0, std::max(1.0, amplitudes->range().upper * 1.15));
    const double end = std::max(toSeconds(session.length), 1e-3);
    course_->xAxis->setRange(0, end);
    marked_ = operatorMarks(session);
    drawMarks();
    colour();
}

void SessionPreview::drawMarks() { marks_->draw(marked_, {course_->axisRect()}); }

void SessionPreview::colour() {
    stylePlot(*course_);
    styleAxis(*course_->yAxis2);
    course_->yAxis2->grid()->setVisible(false);
    const auto& c = colours();
    fitLegend(*course_);
    for (int i = 0; i < course_->graphCount(); ++i) {
        auto* graph = course_->graph(i);
        const bool train = graph->lineStyle() == QCPGraph::lsImpulse;
        graph->setPen(train    ? QPen(c.text)
                      : i == 0 ? QPen(conditionInTheme("rough-high").color)
                               : QPen(conditionInTheme("smooth-high").color, 1, Qt::DashLine));
    }
    marks_->colour();
    course_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui

#include "moc_SessionPreview.cpp"
