#include "app/gui/live/ProfilePreview.h"

#include <cmath>

#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "core/encoding/Encoder.h"
#include "core/encoding/PulseTrain.h"

namespace tacto::gui {

namespace {

constexpr int kPoints = 101;
constexpr std::size_t kWavePoints = 2000;
constexpr double kRounding = 1e-9;  // an imbalance below this is a rounding error, not charge

QCPAxisRect* cell(QCustomPlot& plot, int row, const QString& y) {
    auto* axes = new QCPAxisRect(&plot);
    plot.plotLayout()->addElement(row + 1, 0, axes);
    axes->axis(QCPAxis::atLeft)->setLabel(y);
    for (const auto side : {QCPAxis::atBottom, QCPAxis::atLeft}) {
        axes->axis(side)->ticker()->setTickCount(3);
        axes->axis(side)->setLayer("axes");
        axes->axis(side)->grid()->setLayer("grid");
    }
    return axes;
}

}  // namespace

ProfilePreview::ProfilePreview(QWidget* parent)
    : QCustomPlot(parent), impedance_ohm_(std::nan("")), roughness_(std::nan("")), pressure_(std::nan("")) {
    setAccessibleName(tr("Preview of the encoding"));
    setToolTip(
        tr("What the profile makes of R and P, with a dot at the present touch; and one pulse at the largest "
           "amplitude."));
    addPlotMenu(*this, "encoding");
    auto* unused = axisRect();
    amplitude_ = cell(*this, 0, tr("Amplitude (V)"));
    interval_ = cell(*this, 1, tr("Interval (s)"));
    pulse_ = cell(*this, 2, tr("Pulse (V)"));
    pulse_->axis(QCPAxis::atBottom)->setLabel(tr("Time (µs)"));
    plotLayout()->remove(unused);
    plotLayout()->simplify();
    auto* group = new QCPMarginGroup(this);
    for (auto* axes : {amplitude_, interval_, pulse_}) axes->setMarginGroup(QCP::msLeft, group);
    const auto graphIn = [this](QCPAxisRect* axes) {
        return addGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    };
    amplitudeCurve_ = graphIn(amplitude_);
    intervalCurve_ = graphIn(interval_);
    amplitudePoint_ = graphIn(amplitude_);
    intervalPoint_ = graphIn(interval_);
    for (auto* point : {amplitudePoint_, intervalPoint_}) point->setLineStyle(QCPGraph::lsNone);
    wave_ = graphIn(pulse_);
    setMinimumSize(fontMetrics().height() * 20, fontMetrics().height() * 22);
    colour();
    onLookChange(*this, [this] { colour(); });
}

void ProfilePreview::show(const EncodingProfile& profile, Ohms smallestLoad) {
    smallestLoad_ohm_ = smallestLoad.value();
    if (profile_ && *profile_ == profile) return;
    profile_ = profile;
    showCurves();
    showPulse();
    showPoint();
    replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePreview::showCurves() {
    const Encoder encoder(*profile_);
    const bool swapped = profile_->assignment == Assignment::Swapped;
    amplitude_->axis(QCPAxis::atBottom)->setLabel(swapped ? tr("Pressure P") : tr("Roughness R"));
    interval_->axis(QCPAxis::atBottom)->setLabel(swapped ? tr("Roughness R") : tr("Pressure P"));
    QVector<double> x(kPoints), a(kPoints), t(kPoints);
    for (int i = 0; i < kPoints; ++i) {
        x[i] = double(i) / (kPoints - 1);
        const auto command = encoder.encode(x[i], x[i]);
        a[i] = command ? command->amplitude.value() : std::nan("");
        t[i] = command ? command->interval.count() : std::nan("");
    }
    amplitudeCurve_->setData(x, a, true);
    intervalCurve_->setData(x, t, true);
    const auto spread = [](QCPAxisRect* axes, double high) {
        axes->axis(QCPAxis::atBottom)->setRange(0, 1);
        axes->axis(QCPAxis::atLeft)->setRange(0, high * 1.12);
    };
    spread(amplitude_, profile_->amplitudeMax.value());
    spread(interval_, profile_->intervalMax.count());
}

void ProfilePreview::showPulse() {
    const auto train = voltageTrain(*profile_, profile_->amplitudeMax);
    const double duration = train.pulseDuration().count();
    const double margin = 0.15 * duration;
    const double step = (duration + 2 * margin) / double(kWavePoints);
    // Draws one pulse only: the next would lie outside the picture, or inside it and mislead.
    auto single = train;
    single.pulses = 1;
    std::vector<double> level(kWavePoints);
    QVector<double> times, levels;
    fluxFirst_Vs_ = fluxSecond_Vs_ = 0;
    const double sign = train.polarity == Polarity::Positive ? 1 : -1;
    if (synthesize(single, Hertz(1 / step), level, Seconds(-margin))) {
        for (std::size_t i = 0; i < level.size(); ++i) {
            times << (double(i) * step - margin) * 1e6;
            levels << level[i];
            (level[i] * sign > 0 ? fluxFirst_Vs_ : fluxSecond_Vs_) += level[i] * step;
        }
    }
    wave_->setData(times, levels, true);
    const double reach = profile_->amplitudeMax.value() * 1.2;
    pulse_->axis(QCPAxis::atBottom)->setRange(-margin * 1e6, (duration + margin) * 1e6);
    pulse_->axis(QCPAxis::atLeft)->setRange(-reach, reach);
}

void ProfilePreview::setPoint(double roughness, double pressure) {
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (same(roughness, roughness_) && same(pressure, pressure_)) return;
    roughness_ = roughness;
    pressure_ = pressure;
    showPoint();
    replot(QCustomPlot::rpQueuedReplot);
}

void ProfilePreview::setImpedance(double ohm) { impedance_ohm_ = ohm; }

void ProfilePreview::showPoint() {
    amplitudePoint_->data()->clear();
    intervalPoint_->data()->clear();
    if (!profile_ || !std::isfinite(roughness_)) return;
    const auto pressure = std::isfinite(pressure_) ? std::optional(pressure_) : std::nullopt;
    const auto command = Encoder(*profile_).encode(roughness_, pressure);
    if (!command) return;
    const bool swapped = profile_->assignment == Assignment::Swapped;
    const double P = pressure.value_or(0);
    amplitudePoint_->addData(swapped ? P : roughness_, command->amplitude.value());
    intervalPoint_->addData(swapped ? roughness_ : P, command->interval.count());
}

std::optional<QPointF> ProfilePreview::marked() const {
    if (amplitudePoint_->data()->isEmpty()) return std::nullopt;
    return QPointF(amplitudePoint_->data()->constBegin()->value, intervalPoint_->data()->constBegin()->value);
}

QString ProfilePreview::facts() const {
    if (!profile_) return {};
    const bool measured = std::isfinite(impedance_ohm_);
    const double ohm = measured ? impedance_ohm_ : smallestLoad_ohm_;
    const double larger = std::max(std::abs(fluxFirst_Vs_), std::abs(fluxSecond_Vs_));
    double imbalance = larger > 0 ? std::abs(fluxFirst_Vs_ + fluxSecond_Vs_) / larger : 0;
    if (imbalance < kRounding) imbalance = 0;
    const auto train = voltageTrain(*profile_, profile_->amplitudeMax);
    return tr("At %1 into %2 (%3): %4 per phase, imbalance %5. A pulse lasts %6; %7 in a train.")
        .arg(settingText(profile_->amplitudeMax.value(), "V"), quantityText(ohm, "ohm", 3),
             measured ? tr("measured") : tr("the profile's smallest load"), quantityText(larger / ohm, "C", 3),
             quantityText(100 * imbalance, "%", 3), quantityText(train.pulseDuration().count(), "s", 3))
        .arg(train.pulses);
}

void ProfilePreview::colour() {
    stylePlot(*this);
    const auto& c = colours();
    amplitudeCurve_->setPen(QPen(c.voltage, 1.5));
    intervalCurve_->setPen(QPen(c.current, 1.5));
    for (auto* point : {amplitudePoint_, intervalPoint_})
        point->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, c.text, c.text, 9));
    wave_->setPen(QPen(c.voltage, 1));
}

}  // namespace tacto::gui

#include "moc_ProfilePreview.cpp"
