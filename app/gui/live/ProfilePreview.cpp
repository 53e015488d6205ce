#include "app/gui/live/ProfilePreview.h"

#include "app/gui/look/Look.h"
#include "core/encoding/Encoder.h"
#include "core/encoding/Waveform.h"

namespace tacto::gui {

namespace {

constexpr int kPoints = 101;
constexpr std::size_t kWavePoints = 2000;

QCPAxisRect* cell(QCustomPlot& plot, int row, const QString& y) {
    auto* axes = new QCPAxisRect(&plot);
    plot.plotLayout()->addElement(row + 1, 0, axes);
    axes->axis(QCPAxis::atLeft)->setLabel(y);
    for (const auto side : {QCPAxis::atBottom, QCPAxis::atLeft}) {
        axes->axis(side)->ticker()->setTickCount(4);
        axes->axis(side)->setLayer("axes");
        axes->axis(side)->grid()->setLayer("grid");
    }
    return axes;
}

}  // namespace

ProfilePreview::ProfilePreview(QWidget* parent) : QCustomPlot(parent) {
    setAccessibleName(tr("Preview of the encoding"));
    setToolTip(tr("What the profile makes of R and P, and the shape of one pulse at the largest amplitude."));
    auto* unused = axisRect();
    amplitude_ = cell(*this, 0, tr("amplitude (V)"));
    interval_ = cell(*this, 1, tr("interval (s)"));
    pulse_ = cell(*this, 2, tr("pulse (V)"));
    pulse_->axis(QCPAxis::atBottom)->setLabel(tr("time (µs)"));
    plotLayout()->remove(unused);
    plotLayout()->simplify();
    const auto graphIn = [this](QCPAxisRect* axes) {
        return addGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    };
    amplitudeCurve_ = graphIn(amplitude_);
    intervalCurve_ = graphIn(interval_);
    wave_ = graphIn(pulse_);
    setMinimumSize(fontMetrics().height() * 24, fontMetrics().height() * 20);
    colour();
}

void ProfilePreview::show(const EncodingProfile& profile) {
    const Encoder encoder(profile);
    const bool swapped = profile.assignment == Assignment::Swapped;
    amplitude_->axis(QCPAxis::atBottom)->setLabel(swapped ? tr("pressure P") : tr("roughness R"));
    interval_->axis(QCPAxis::atBottom)->setLabel(swapped ? tr("roughness R") : tr("pressure P"));
    QVector<double> x(kPoints), a(kPoints), t(kPoints);
    for (int i = 0; i < kPoints; ++i) {
        x[i] = double(i) / (kPoints - 1);
        const auto command = encoder.encode(x[i], x[i]);
        a[i] = command ? command->amplitude.value() : std::nan("");
        t[i] = command ? command->interval.count() : std::nan("");
    }
    amplitudeCurve_->setData(x, a, true);
    intervalCurve_->setData(x, t, true);
    const auto spread = [](QCPAxisRect* axes, double low, double high) {
        axes->axis(QCPAxis::atBottom)->setRange(0, 1);
        axes->axis(QCPAxis::atLeft)->setRange(std::min(0.0, low), high * 1.08);
    };
    spread(amplitude_, 0, profile.amplitudeMax.value());
    spread(interval_, 0, profile.intervalMax.count());

    const auto train = voltageTrain(profile, profile.amplitudeMax);
    const double duration = train.pulseDuration().count();
    const double margin = 0.15 * duration;
    const double step = (duration + 2 * margin) / double(kWavePoints);
    std::vector<double> level(kWavePoints);
    QVector<double> times, levels;
    double first = 0, second = 0;
    if (synthesize(train, Hertz(1 / step), level, Seconds(-margin))) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            times << (double(i) * step - margin) * 1e6;
            levels << level[i];
            (level[i] > 0 ? first : second) += level[i] * step;
        }
    }
    wave_->setData(times, levels, true);
    const double reach = profile.amplitudeMax.value() * 1.15;
    pulse_->axis(QCPAxis::atBottom)->setRange(-margin * 1e6, (duration + margin) * 1e6);
    pulse_->axis(QCPAxis::atLeft)->setRange(-reach, reach);
    const double larger = std::max(std::abs(first), std::abs(second));
    facts_ = tr("At %1 into 1 kΩ: %2 per phase, imbalance %3, pulse %4 long, %5 in a train.")
                 .arg(settingText(profile.amplitudeMax.value(), "V"), quantityText(larger / 1000, "C", 3),
                      quantityText(larger > 0 ? 100 * std::abs(first + second) / larger : 0, "%", 2),
                      quantityText(duration, "s", 3))
                 .arg(train.pulses);
    replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePreview::colour() {
    stylePlot(*this);
    const auto& c = colours();
    amplitudeCurve_->setPen(QPen(c.voltage, 1.5));
    intervalCurve_->setPen(QPen(c.current, 1.5));
    wave_->setPen(QPen(c.voltage, 1));
}

void ProfilePreview::changeEvent(QEvent* event) {
    if ((event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) && wave_ != nullptr) colour();
    QCustomPlot::changeEvent(event);
}

}  // namespace tacto::gui
