#include "drivers/simulated/Finger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tacto::sim {

namespace {
constexpr double kPi = std::numbers::pi;
constexpr double kForceTime = 0.02;  // time constant in seconds; a hand presses within a few of these
constexpr double kSpeedTime = 0.04;
constexpr double kTouching = 0.01;     // N; below this the skin does not touch
constexpr double kTremorForce = 0.03;  // tremor as a fraction of force, r.m.s.
constexpr double kTremorSpeed = 0.05;
constexpr double kTremorAir = 0.05;     // m/s² r.m.s. of an unsupported hand
constexpr double kTremorContact = 0.6;  // factor on the tremor while the surface steadies the hand
constexpr double kDrag = 0.9;           // m/s² r.m.s. at 1 N, 50 mm/s, friction 0.7
constexpr double kDragFriction = 0.7;
constexpr double kDragCorner = 80;      // Hz
constexpr double kRelief = 0.17;        // share of the skin's motion that the accelerometer measures
constexpr double kFlicker = 0.75;       // m/s² per unit of white force, at 1 N and 50 mm/s
constexpr double kNominalSpeed = 0.05;  // m/s
constexpr std::array<double, 3> kDragAxis{1.0, 0.8, 0.8};
constexpr std::array<double, 3> kSkinAxis{0.6, 0.3, 1.0};
constexpr std::array<double, 3> kTremorAxis{0.6, 0.5, 0.6};

// The taxel array: two rows of four, 2.5 mm apart, under a pad with a contact radius that grows as in a Hertz contact.
// The array is equalised at 1 N, so its readings show only how the pressure's shape differs from that at 1 N.
constexpr double kPitch = 2.5e-3;
constexpr double kRadius1N = 6e-3;
constexpr double kSmallestRadius = 0.75;  // share of kRadius1N: at first touch the pad already covers the array
constexpr double kDome = 0.02;
constexpr double kContactArea = 1e-4;  // m²
}  // namespace

void Finger::Resonator::tune(double frequency_hz, double bandwidth_hz, double rate_hz) noexcept {
    const double r = std::exp(-kPi * bandwidth_hz / rate_hz);
    const double theta = 2 * kPi * frequency_hz / rate_hz;
    a1 = 2 * r * std::cos(theta);
    a2 = -r * r;
    gain = std::sqrt((1 - r * r) * (1 + r * r * r * r - 2 * r * r * std::cos(2 * theta)) / (1 + r * r));
}

double Finger::Resonator::next(double white) noexcept {
    const double y = a1 * y1 + a2 * y2 + gain * white;
    y2 = y1;
    y1 = y;
    return y;
}

void Finger::Wander::tune(double corner_hz, double rate_hz) noexcept {
    keep = std::exp(-2 * kPi * corner_hz / rate_hz);
    // Variance of three equal poles driven by white noise of variance 1: (1 + 4q + q²) / (1 - q)⁵, q = keep².
    const double q = keep * keep;
    gain = std::sqrt(std::pow(1 - q, 5) / (1 + 4 * q + q * q));
}

double Finger::Wander::next(double white) noexcept {
    y1 = keep * y1 + gain * white;
    y2 = keep * y2 + y1;
    y3 = keep * y3 + y2;
    return y3;
}

Finger::Finger(const FingerSettings& settings, Instant opened)
    : settings_(settings),
      opened_(toSeconds(opened)),
      dt_(1 / settings.tickRate_hz),
      nextTarget_(std::numeric_limits<double>::infinity()),
      time_(opened_),
      noise_(settings.seed, "finger") {
    tremor_.tune(10, 2, settings_.tickRate_hz);
    for (auto& axis : drag_) axis.tune(kDragCorner, settings_.tickRate_hz);
    // Skin: a = ω²s² / (s² + 2ζωs + ω²) of the height below it, ω² / (...) of a force on it; bilinear, prewarped.
    const double omega = 2 * kPi * settings_.resonance.value();
    const double k = omega / std::tan(omega * dt_ / 2);
    const double a0 = k * k + 2 * settings_.damping * omega * k + omega * omega;
    skinA1_ = -2 * (omega * omega - k * k) / a0;
    skinA2_ = -(k * k - 2 * settings_.damping * omega * k + omega * omega) / a0;
    heightGain_ = kRelief * omega * omega * k * k / a0;
    // White force noise at a higher rate must keep the same power per hertz.
    flickerGain_ = kFlicker * std::sqrt(settings_.tickRate_hz / 4000) * omega * omega / a0;
    surface_ = surfaceOf(settings_.material);
    const std::lock_guard lock(mutex_);
    planStroke(opened_ + kFirstContact.count());
}

const Surface* Finger::surfaceOf(std::string_view material) {
    if (const auto known = surfaces_.find(material); known != surfaces_.end()) return known->second.get();
    const auto* found = findMaterial(material);
    if (found == nullptr) return nullptr;
    Material specimen = *found;
    if (settings_.gratingPeriod.value() > 0) {
        specimen.gratingPeriod = settings_.gratingPeriod;
        specimen.gratingDepth = settings_.gratingDepth;
    }
    auto made = std::make_unique<Surface>(specimen, settings_.seed);
    return surfaces_.emplace(material, std::move(made)).first->second.get();
}

void Finger::planStroke(double after_s) {
    targets_.push_back({after_s, nullptr, settings_.speed.value() * 1e-3, settings_.force.value()});
    if (settings_.lift.count() > 0) targets_.push_back({after_s + settings_.stroke.count(), nullptr, 0, 0});
    nextTarget_.store(targets_.front().from_s, std::memory_order_release);
}

Result<void> Finger::present(std::string_view material, MillimetresPerSecond speed, Newtons force, Instant now) {
    if (!(speed.value() >= 0) || !(speed.value() <= 1000)) {
        return fail(ErrorCode::InvalidArgument, "a finger cannot slide at {} mm/s: 0 to 1000 mm/s", speed.value());
    }
    if (!(force.value() >= 0) || !(force.value() <= 20)) {
        return fail(ErrorCode::InvalidArgument, "a finger cannot press with {} N: 0 to 20 N", force.value());
    }
    const std::lock_guard lock(mutex_);
    const Surface* surface = material.empty() ? nullptr : surfaceOf(material);
    if (surface == nullptr && !material.empty()) {
        return fail(ErrorCode::InvalidArgument, "there is no material \"{}\": {}", material, materialNames());
    }
    const double at = toSeconds(now);
    const double earliest = opened_ + kFirstContact.count();
    // Plans motions up to `at`: they still happen in ticks not read yet, later motions do not.
    while (!presented_ && settings_.lift.count() > 0 && !targets_.empty() && targets_.back().from_s <= at) {
        planStroke(targets_.back().from_s + settings_.lift.count());
    }
    while (!targets_.empty() && targets_.back().from_s > at) targets_.pop_back();
    if (material.empty()) {
        targets_.push_back({at, nullptr, 0, 0});
        presentedMaterial_.clear();
    } else if (presented_ && presentedMaterial_ == material) {
        targets_.push_back({std::max(at, landed_), surface, speed.value() * 1e-3, force.value()});
    } else {
        landed_ = std::max(at + kChange.count(), earliest);
        targets_.push_back({at, nullptr, 0, 0});
        targets_.push_back({landed_, surface, speed.value() * 1e-3, force.value()});
        presentedMaterial_ = material;
    }
    presented_ = true;
    nextTarget_.store(targets_.front().from_s, std::memory_order_release);
    return {};
}

void Finger::follow() noexcept {
    const std::lock_guard lock(mutex_);
    while (!targets_.empty() && targets_.front().from_s < time_) {
        const Target target = targets_.front();
        targets_.pop_front();
        if (target.surface != nullptr) surface_ = target.surface;
        targetSpeed_ = target.speed_m_s;
        targetForce_ = target.force_N;
        if (targets_.empty() && !presented_ && settings_.lift.count() > 0) {
            planStroke(target.from_s + settings_.lift.count());
        }
    }
    nextTarget_.store(targets_.empty() ? std::numeric_limits<double>::infinity() : targets_.front().from_s,
                      std::memory_order_release);
}

void Finger::moveHand() noexcept {
    const double tremor = settings_.tremor * tremor_.next(noise_.normal());
    const double pull = (targetForce_ - force_) / kForceTime - 2 * forceRate_;
    forceRate_ += pull / kForceTime * dt_;
    force_ += forceRate_ * dt_;
    if (targetForce_ <= 0 && force_ < kTouching) force_ = forceRate_ = 0;
    contactForce_ = force_ < kTouching ? 0 : force_ * std::max(0.0, 1 + kTremorForce * tremor);
    speed_ += (targetSpeed_ - speed_) * dt_ / kSpeedTime;
    if (contactForce_ > 0) position_ += speed_ * std::max(0.0, 1 + kTremorSpeed * tremor) * dt_;
    const double shake = kTremorAir * tremor * (contactForce_ > 0 ? kTremorContact : 1);
    for (std::size_t axis = 0; axis < 3; ++axis) acceleration_[axis] = kTremorAxis[axis] * shake;
    acceleration_[2] += kGravity;
}

void Finger::feel() noexcept {
    const double z = contactForce_ > 0 ? surface_->contactHeight(position_) : 0;
    const double slip = 2 * speed_ / (speed_ + kNominalSpeed);  // factor: 1 at the nominal speed, 0 at rest
    const double f = flickerScale_ * slip * noise_.normal();
    const double excited = heightGain_ * (z - 2 * z1_ + z2_) + flickerGain_ * (f + 2 * f1_ + f2_);
    const double skin = excited + skinA1_ * s1_ + skinA2_ * s2_;
    z2_ = z1_;
    z1_ = z;
    f2_ = f1_;
    f1_ = f;
    s2_ = s1_;
    s1_ = skin;
    if (contactForce_ <= 0) return;
    const double grip = std::sqrt(contactForce_);
    const double drag = kDrag * surface_->material().friction / kDragFriction * slip;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        acceleration_[axis] +=
            grip * (kSkinAxis[axis] * skin + drag * kDragAxis[axis] * drag_[axis].next(noise_.normal()));
    }
}

void Finger::step() noexcept {
    ++tick_;
    time_ = opened_ + static_cast<double>(tick_) * dt_;
    if (nextTarget_.load(std::memory_order_acquire) < time_) follow();
    moveHand();
    flickerScale_ = surface_->flicker();
    feel();
}

void Finger::pressures(std::array<double, kTaxels>& into) const noexcept {
    const double mean = contactForce_ / kContactArea;
    const double relative = std::max(kSmallestRadius, std::cbrt(contactForce_));
    const double radius = kRadius1N * relative;
    constexpr double kMeanSquare = (1.25e-3 * 1.25e-3 + 3.75e-3 * 3.75e-3) / 2 + 1.25e-3 * 1.25e-3;
    for (std::size_t i = 0; i < kTaxels; ++i) {
        const double along = (static_cast<double>(i % 4) - 1.5) * kPitch;
        const std::size_t row = i / 4;
        const double across = (static_cast<double>(row) - 0.5) * kPitch;
        const double square = along * along + across * across - kMeanSquare;
        const double shape = 1 - kDome * square * (1 / (radius * radius) - 1 / (kRadius1N * kRadius1N));
        const double uneven = surface_->bearing(i, position_ + along + 0.01);
        into[i] = mean * shape * (1 + uneven);
    }
}

}  // namespace tacto::sim
