// The oscilloscope's screen: ten million samples per channel, panned and zoomed at 1280x720 on the raster engine,
// compared with QCustomPlot's own graph of the same samples and with an empty plot. Also builds the min-max pyramid,
// compared with reading the samples once.
//
// Goals: 3 ms per frame for two channels of pulses, 4 ms for noise of full height, 200 million samples/s on one core.
#include <QApplication>
#include <benchmark/benchmark.h>
#include <cmath>
#include <numeric>

#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/Theme.h"
#include "core/base/Random.h"
#include "tests/perf/Windows.h"

namespace tacto {
namespace {

constexpr std::size_t kSamples = 10'000'000;
constexpr double kRate_hz = 10e6;
const QSize kScreen(1280, 720);

enum Signal { kPulses, kNoise };

/// Returns biphasic pulses of 200 µs every 10 ms with a little noise, or noise over the full range.
std::shared_ptr<const std::vector<float>> samplesOf(Signal signal) {
    static std::shared_ptr<const std::vector<float>> made[2];
    if (made[signal]) return made[signal];
    auto samples = std::make_shared<std::vector<float>>(kSamples);
    Random random(3, "scope benchmark");
    const std::size_t period = static_cast<std::size_t>(10e-3 * kRate_hz);
    const std::size_t phase = static_cast<std::size_t>(200e-6 * kRate_hz);
    for (std::size_t i = 0; i < kSamples; ++i) {
        const std::size_t at = i % period;
        const double pulse = at < phase ? 40 : at > phase + phase / 2 && at < 2 * phase + phase / 2 ? -40 : 0;
        (*samples)[i] =
            static_cast<float>(signal == kNoise ? 80 * (random.uniform() - 0.5) * (1 + 0.2 * random.uniform())
                                                : pulse + 0.1 * random.normal());
    }
    made[signal] = samples;
    return samples;
}

/// View of the k-th frame: panning through the record while zooming from the whole record to a hundredth and back.
struct Look {
    double perDivision_s, centre_s;
};
Look frame(std::size_t k) {
    static const std::vector<double> steps{0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05};
    const double length = static_cast<double>(kSamples) / kRate_hz;
    const double step = steps[(k / 8) % steps.size()];
    return {step, length * (0.3 + 0.4 * static_cast<double>(k % 97) / 97)};
}

void BM_ScopeFrame(benchmark::State& state) {
    needWindows();
    auto shown = std::make_shared<gui::ShownCapture>();
    auto capture = std::make_shared<Capture>();
    capture->rate_hz = kRate_hz;
    capture->trigger_s = NAN;
    capture->channels.resize(2);
    capture->channels[0].samples.resize(kSamples);
    shown->capture = capture;
    const auto samples = samplesOf(static_cast<Signal>(state.range(0)));
    shown->traces.push_back(gui::makeTrace("channel/voltage", "Voltage", "V", samples, kRate_hz, 0, 0));
    shown->traces.push_back(gui::makeTrace("channel/current", "Current", "A", samples, kRate_hz, 0, 0));
    gui::ScopeModel model;
    gui::ScopeScreen screen(model);
    screen.resize(kScreen);
    screen.QWidget::show();
    model.show(shown);
    if (state.range(0) == kNoise) {
        for (const auto& lane : model.lanes()) {  // each lane spans the whole height
            model.setLaneScale(lane.key, 10);
            model.setLanePosition(lane.key, 0);
        }
    }
    std::size_t k = 0;
    for (auto _ : state) {
        const auto look = frame(k++);
        model.setTimePerDivision(look.perDivision_s);
        model.setTimeCentre(look.centre_s);
        screen.replot(QCustomPlot::rpImmediateRefresh);
    }
}
BENCHMARK(BM_ScopeFrame)->ArgName("noise")->Arg(kPulses)->Arg(kNoise)->Unit(benchmark::kMillisecond);

/// The library's own graph for the same samples, with its fastest settings: no antialiasing, adaptive sampling.
void BM_ScopeFrameBaselineGraph(benchmark::State& state) {
    needWindows();
    QCustomPlot plot;
    plot.setNotAntialiasedElements(QCP::aeAll);
    plot.setPlottingHints(QCP::phFastPolylines);
    plot.resize(kScreen);
    const auto samples = samplesOf(static_cast<Signal>(state.range(0)));
    auto data = QSharedPointer<QCPGraphDataContainer>::create();
    {
        QVector<QCPGraphData> points;
        points.reserve(static_cast<qsizetype>(kSamples));
        for (std::size_t i = 0; i < kSamples; ++i) {
            points.append({static_cast<double>(i) / kRate_hz, static_cast<double>((*samples)[i])});
        }
        data->set(points, true);
    }
    for (const auto& colour : {gui::colours().voltage, gui::colours().current}) {
        auto* graph = plot.addGraph();
        graph->setData(data);
        graph->setPen(QPen(colour, 1));
    }
    plot.yAxis->setRange(-45, 45);
    plot.show();
    std::size_t k = 0;
    for (auto _ : state) {
        const auto look = frame(k++);
        plot.xAxis->setRange(look.centre_s - 5 * look.perDivision_s, look.centre_s + 5 * look.perDivision_s);
        plot.replot(QCustomPlot::rpImmediateRefresh);
    }
}
BENCHMARK(BM_ScopeFrameBaselineGraph)->ArgName("noise")->Arg(kPulses)->Arg(kNoise)->Unit(benchmark::kMillisecond);

void BM_ScopeFrameBaselineEmpty(benchmark::State& state) {
    needWindows();
    QCustomPlot plot;
    plot.setNotAntialiasedElements(QCP::aeAll);
    plot.resize(kScreen);
    plot.show();
    std::size_t k = 0;
    for (auto _ : state) {
        const auto look = frame(k++);
        plot.xAxis->setRange(look.centre_s - 5 * look.perDivision_s, look.centre_s + 5 * look.perDivision_s);
        plot.replot(QCustomPlot::rpImmediateRefresh);
    }
}
BENCHMARK(BM_ScopeFrameBaselineEmpty)->Unit(benchmark::kMillisecond);

void countSamples(benchmark::State& state) {
    state.counters["samples/s"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * kSamples, benchmark::Counter::kIsRate);
}

void BM_PyramidBuild(benchmark::State& state) {
    const auto samples = samplesOf(kNoise);
    for (auto _ : state) {
        MinMaxPyramid pyramid;
        pyramid.extend(*samples);
        benchmark::DoNotOptimize(pyramid.over(0, kSamples));
    }
    countSamples(state);
}
BENCHMARK(BM_PyramidBuild)->Unit(benchmark::kMillisecond);

/// Adds samples as they arrive: 4096 at a time.
void BM_PyramidGrow(benchmark::State& state) {
    const auto samples = samplesOf(kNoise);
    const std::span<const float> all(*samples);
    for (auto _ : state) {
        MinMaxPyramid pyramid;
        for (std::size_t n = 4096; n < kSamples; n += 4096) pyramid.extend(all.first(n));
        pyramid.extend(all);
        benchmark::DoNotOptimize(pyramid.over(0, kSamples));
    }
    countSamples(state);
}
BENCHMARK(BM_PyramidGrow)->Unit(benchmark::kMillisecond);

void BM_PyramidBaselineSum(benchmark::State& state) {
    const auto samples = samplesOf(kNoise);
    for (auto _ : state) benchmark::DoNotOptimize(std::accumulate(samples->begin(), samples->end(), 0.0F));
    countSamples(state);
}
BENCHMARK(BM_PyramidBaselineSum)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tacto
