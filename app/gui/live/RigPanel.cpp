#include "app/gui/live/RigPanel.h"

#include <QGridLayout>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/TypedSpin.h"

namespace tacto::gui {

namespace {
constexpr const char* kMaterials[] = {"glass", "plastic", "paper", "denim", "P400", "P120", "P60"};  // smooth to rough
constexpr double kPaces[] = {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0};
}  // namespace

RigPanel::RigPanel(BenchController& controller, QWidget* parent) : QWidget(parent), controller_(controller) {
    auto* layout = columnIn(*this);
    surfaces_ = buildSurfaces();
    layout->addWidget(surfaces_);
    pace_ = buildPace();
    layout->addWidget(pace_);
    connect(&controller_, &BenchController::presented, this, &RigPanel::follow);
    begin(1, false);
}

QWidget* RigPanel::buildSurfaces() {
    auto* group = new QGroupBox(tr("Under the simulated finger"), this);
    auto* fields = layoutIn<QGridLayout>(*group, -1, {});
    material_ = new QComboBox(group);
    material_->setObjectName("surface");
    material_->addItem(tr("nothing (lifted)"), "");  // begin() adds the finger's own strokes
    for (const auto* name : kMaterials) material_->addItem(name, name);
    material_->setToolTip(tr("The surface under the sliding finger, from smooth to rough."));
    const auto spin = [&](double low, double high, double step, int decimals, double value, const QString& unit) {
        auto* box = new TypedSpin(group);
        box->setRange(low, high);
        box->setSingleStep(step);
        box->setDecimals(decimals);
        box->setValue(value);
        box->setSuffix(unit);
        box->setKeyboardTracking(false);
        connect(box, &QDoubleSpinBox::valueChanged, this, &RigPanel::present);
        return box;
    };
    speed_ = spin(0, 200, 5, 0, 50, QStringLiteral("\u202fmm/s"));
    speed_->setToolTip(tr("Sliding speed. At 0 the finger rests on the surface and feels no vibration."));
    force_ = spin(0.05, 10, 0.1, 2, 1, QStringLiteral("\u202fN"));
    force_->setObjectName("fingerForce");
    force_->setToolTip(tr("How hard the finger presses."));
    connect(material_, &QComboBox::currentIndexChanged, this, &RigPanel::present);
    const auto add = [&](const QString& name, QWidget* field, int row, int column, int span) {
        auto* label = new QLabel(name, group);
        label->setBuddy(field);
        fields->addWidget(label, row, column);
        fields->addWidget(field, row, column + 1, 1, span);
    };
    add(tr("S&urface"), material_, 0, 0, 3);
    add(tr("Sp&eed"), speed_, 1, 0, 1);
    add(tr("Force"), force_, 1, 2, 1);
    fields->setColumnStretch(1, 1);
    fields->setColumnStretch(3, 1);
    return group;
}

QWidget* RigPanel::buildPace() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder);
    paceLabel_ = new QLabel(holder);
    paceBox_ = new QComboBox(holder);
    paceBox_->setObjectName("pace");
    for (const double pace : kPaces) paceBox_->addItem(tr("%1 ×").arg(pace), pace);
    paceBox_->setAccessibleName(tr("Speed of time"));
    paceBox_->setToolTip(
        tr("How fast the bench's time runs against the clock on the wall. Intervals and rates are in "
           "the bench's time."));
    paceLabel_->setBuddy(paceBox_);
    again_ = new QPushButton(tr("Replay a&gain"), holder);
    again_->setToolTip(tr("Plays the recording from its beginning, into a session file of its own."));
    addAll(*row, {paceLabel_, paceBox_});
    row->addStretch();
    row->addWidget(again_);
    connect(paceBox_, &QComboBox::currentIndexChanged, this, [this] { controller_.setSpeed(speed()); });
    connect(again_, &QPushButton::clicked, this, &RigPanel::replayAgain);
    return holder;
}

void RigPanel::begin(double speed, bool recording) {
    const auto open = controller_.open();
    const bool live = controller_.activity() == Activity::Live;
    recording_ = recording;
    surfaces_->setVisible(live && open && open->surfaces);
    pace_->setVisible(live && open && open->paced);
    paceLabel_->setText(recording ? tr("Replay spee&d") : tr("Ti&me runs at"));
    again_->setVisible(false);
    const QSignalBlocker quietMaterial(material_), quietPace(paceBox_), quietSpeed(speed_), quietForce(force_);
    // Until the user chooses, the finger moves as its device was opened; that cannot be chosen again later.
    if (material_->itemData(0).isValid()) material_->insertItem(0, tr("its own strokes"));
    material_->setCurrentIndex(0);
    speed_->setValue(50);
    force_->setValue(1);
    enableRest();
    paceBox_->setCurrentIndex(paceBox_->findData(speed));
}

void RigPanel::refresh(const Telemetry& telemetry) { again_->setVisible(recording_ && telemetry.sensorFinished); }

void RigPanel::enableRest() {
    const bool ours = material_->currentData().isValid();
    const bool touches = ours && !material_->currentData().toString().isEmpty();
    for (auto* box : {speed_, force_}) box->setEnabled(touches);
}

void RigPanel::endOwnStrokes() {
    const QSignalBlocker quiet(material_);
    if (!material_->itemData(0).isValid()) material_->removeItem(0);
}

void RigPanel::present() {
    if (!material_->currentData().isValid()) return;
    endOwnStrokes();
    enableRest();
    controller_.present(material_->currentData().toString().toStdString(), speed_->value(), force_->value());
}

void RigPanel::follow(const QString& material, double speed_mm_s, double force_n) {
    endOwnStrokes();
    const QSignalBlocker quietMaterial(material_), quietSpeed(speed_), quietForce(force_);
    if (const int known = material_->findData(material); known >= 0) material_->setCurrentIndex(known);
    speed_->setValue(speed_mm_s);
    force_->setValue(force_n);
    enableRest();
}

}  // namespace tacto::gui

#include "moc_RigPanel.cpp"
