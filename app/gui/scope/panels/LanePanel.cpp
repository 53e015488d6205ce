#include "app/gui/scope/panels/LanePanel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

/// Offers only the scales within three decades of the present one; the whole ladder would be too long.
void offerScales(QComboBox& box, double now, const QString& unit) {
    const QSignalBlocker quiet(&box);
    if (box.findData(now) < 0) {
        box.clear();
        for (const double step : stepsBetween(now / 1200, now * 1200)) addStep(box, step, unit);
    }
    showStep(box, now, unit);
}

}  // namespace

LanePanel::LanePanel(ScopeModel& model, ScopeScreen& screen, QWidget* parent)
    : QWidget(parent),
      model_(model),
      screen_(screen),
      grid_(new QGridLayout),
      store_(new QPushButton(tr("Store as reference"), this)) {
    store_->setToolTip(tr("Keeps the selected lane as it looks now, to compare with later captures."));
    auto* layout = columnIn(*this);
    grid_->setHorizontalSpacing(4);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(1, 1);
    layout->addLayout(grid_);
    layout->addWidget(store_);
    connect(store_, &QPushButton::clicked, this, [this] { model_.storeReference(); });
    connect(&model_, &ScopeModel::lanesChanged, this, &LanePanel::build);
    connect(&model_, &ScopeModel::viewChanged, this, &LanePanel::follow);
    connect(&model_, &ScopeModel::activeLaneChanged, this, &LanePanel::follow);
    build();
    afterLookChange(*this, [this] { follow(); });
}

void LanePanel::build() {
    const auto& lanes = model_.lanes();
    // If only the colours changed, the widgets stay, and so does the focus.
    const bool same = lanes.size() == rows_.size() && std::all_of(lanes.begin(), lanes.end(), [&](const ScopeLane& l) {
                          return rows_.contains(l.key);
                      });
    if (!same) {
        while (auto* item = grid_->takeAt(0)) {
            if (item->widget() != nullptr) item->widget()->deleteLater();
            delete item;
        }
        rows_.clear();
        int row = 0;
        for (const auto& l : lanes) addRow(l, row++);
        // These widgets are made late; in the tab order they belong between the screen and the button below them.
        QWidget* before = &screen_;
        for (const auto& l : lanes) {
            const auto& its = rows_[l.key];
            for (QWidget* next :
                 std::initializer_list<QWidget*>{its.letter, its.shown, its.scale, its.position, its.remove}) {
                if (next == nullptr) continue;
                setTabOrder(before, next);
                before = next;
            }
        }
    }
    follow();
}

void LanePanel::addRow(const ScopeLane& lane, int row) {
    auto& its = rows_[lane.key];
    const auto key = lane.key;
    its.letter = new QToolButton(this);
    its.letter->setText(lane.letter);
    its.letter->setCheckable(true);
    its.letter->setAccessibleName(tr("Work with %1").arg(lane.title));
    its.letter->setToolTip(
        tr("Works with this lane: Ctrl+wheel, level cursors, edges to snap to and the right axis are "
           "its own."));
    connect(its.letter, &QToolButton::clicked, this, [this, key] {
        model_.setActiveLane(key);
        follow();
    });
    its.shown = new QCheckBox(lane.title, this);
    its.shown->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    its.shown->setToolTip(tr("Shows or hides this lane."));
    connect(its.shown, &QCheckBox::clicked, this, [this, key](bool on) { model_.setLaneShown(key, on); });
    grid_->addWidget(its.letter, 2 * row, 0);
    if (lane.reference()) {
        its.remove = new QToolButton(this);
        its.remove->setText(tr("Remove"));
        its.remove->setAccessibleName(tr("Remove %1").arg(lane.title));
        its.remove->setToolTip(tr("Forgets this reference."));
        connect(its.remove, &QToolButton::clicked, this, [this, key] { model_.removeReference(key); });
        grid_->addWidget(its.shown, 2 * row, 1);
        grid_->addWidget(its.remove, 2 * row, 2, Qt::AlignRight);
        return;
    }
    grid_->addWidget(its.shown, 2 * row, 1, 1, 2);
    its.scale = new QComboBox(this);
    its.scale->setAccessibleName(tr("Scale of %1").arg(lane.title));
    its.scale->setToolTip(tr("How much one of the eight divisions is. Ctrl+wheel over the screen does the same."));
    connect(its.scale, &QComboBox::activated, this,
            [this, key, box = its.scale] { model_.setLaneScale(key, box->currentData().toDouble()); });
    its.scale->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    its.scale->setMinimumContentsLength(9);
    its.position = new DivisionSpin(this);
    its.position->setAccessibleName(tr("Offset of %1").arg(lane.title));
    its.position->setToolTip(tr("Where its zero lies: divisions above the middle. Or drag its letter on the screen."));
    connect(its.position, &DivisionSpin::valueChanged, this,
            [this, key](double value) { model_.setLanePosition(key, value); });
    grid_->addWidget(its.scale, 2 * row + 1, 0, 1, 2);
    grid_->addWidget(its.position, 2 * row + 1, 2);
}

void LanePanel::follow() {
    bool canStore = false;
    for (const auto& lane : model_.lanes()) {
        const auto found = rows_.find(lane.key);
        if (found == rows_.end()) continue;
        auto& its = found->second;
        const bool active = lane.key == model_.activeLane();
        canStore = canStore || (active && !lane.reference());
        its.letter->setText(lane.letter);
        its.letter->setChecked(active);
        const auto colour = laneInk(model_, lane);
        const auto letter =
            active ? QString("QToolButton { background: %1; color: %2; }").arg(colour.name(), colours().base.name())
                   : QString("QToolButton { color: %1; }").arg(colour.name());
        if (its.letter->styleSheet() != letter) its.letter->setStyleSheet(letter);
        its.shown->setText(lane.title);
        its.shown->setChecked(lane.shown);
        if (its.scale == nullptr) continue;
        const auto scale = model_.scaleOf(lane);
        offerScales(*its.scale, scale.perDivision, lane.unit);
        its.position->setMinimumWidth(fontMetrics().horizontalAdvance("−0.00 div") + 36);
        const QSignalBlocker quiet(its.position);
        if (!its.position->hasFocus() || std::abs(its.position->value() - scale.position) > 5e-3) {
            its.position->setValue(scale.position);
        }
    }
    store_->setEnabled(canStore && !model_.roll());
}

}  // namespace tacto::gui

#include "moc_LanePanel.cpp"
