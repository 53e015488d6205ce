#include "app/gui/scope/ScopeColumns.h"

#include <QEvent>
#include <QSettings>
#include <QSplitter>

#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/measurements/SpectrumPanel.h"
#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/panels/ScopeControls.h"
#include "app/gui/scope/panels/ScopeStatus.h"
#include "app/gui/scope/panels/ScopeTools.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

const QList<int> kFirstSizes{520, 280, 190};

}  // namespace

ScopeColumns::ScopeColumns(const Parts& parts, QWidget* parent)
    : QWidget(parent), parts_(parts), head_(new QWidget(this)), plots_(new QSplitter(Qt::Vertical, this)) {
    plots_->setChildrenCollapsible(false);
    plots_->addWidget(&parts_.screen);
    plots_->addWidget(&parts_.spectrum);
    plots_->addWidget(&parts_.table);
    plots_->setStretchFactor(0, 5);
    plots_->setStretchFactor(1, 2);
    plots_->setStretchFactor(2, 2);
    plots_->setSizes(kFirstSizes);
    parts_.spectrum.hide();
    parts_.table.hide();

    auto* left = new QWidget(this);
    auto* column = columnIn(*left, 0);
    column->addWidget(plots_, 1);
    column_ = column;
    auto* tools = rowIn(*head_, 0);
    tools->addWidget(&parts_.tools, 1);
    onEvent(*head_, QEvent::Resize, [this] { placeStatus(); });
    placeStatus();

    auto* rows = columnIn(*this, 0);
    rows->addWidget(head_);
    auto* row = new QHBoxLayout;
    row->addWidget(left, 1);
    row->addWidget(&parts_.controls);
    rows->addLayout(row, 1);
    afterLookChange(*this, [this] {
        fitControls();
        placeStatus();
    });
    onEvent(*this, QEvent::Resize, [this] { fitControls(); });
}

void ScopeColumns::askForControls(bool on) {
    wanted_ = on;
    forced_ = on;
    fitControls();
}

void ScopeColumns::reset() {
    plots_->setSizes(kFirstSizes);
    parts_.table.hide();
    parts_.tools.tool(ScopeTool::Table).setChecked(false);
    askForControls(false);
}

void ScopeColumns::fitControls() {
    const int needed =
        parts_.screen.minimumWidth() + parts_.controls.sizeHint().width() + fontMetrics().averageCharWidth() * 4;
    const bool room = width() >= needed;
    if (room) forced_ = false;
    const bool on = wanted_ && (room || forced_);
    parts_.tools.tool(ScopeTool::Controls).setChecked(on);
    parts_.controls.setVisible(on);
}

/// If the tools leave too little room for the status beside them, places the status on a line below.
void ScopeColumns::placeStatus() {
    constexpr int kWide = 1340;  // pixels that the tools, lanes, trigger and captures need
    auto& row = *static_cast<QBoxLayout*>(head_->layout());
    const bool beside = head_->width() >= scaledPx(kWide);
    auto& here = beside ? row : *column_;
    if (here.indexOf(&parts_.status) >= 0) return;
    (beside ? column_ : &row)->removeWidget(&parts_.status);
    beside ? row.addWidget(&parts_.status, 1) : column_->insertWidget(0, &parts_.status);
    row.setStretchFactor(&parts_.tools, beside ? 0 : 1);
}

void ScopeColumns::save(QSettings& settings) const {
    settings.setValue("panels", plots_->saveState());
    settings.setValue("controls", wanted_);
    settings.setValue("table", !parts_.table.isHidden());
}

void ScopeColumns::restore(QSettings& settings) {
    plots_->restoreState(settings.value("panels").toByteArray());  // refuses a state that it did not write
    plots_->setOrientation(Qt::Vertical);
    plots_->setChildrenCollapsible(false);
    // At the first start the screen gets all the room; the user opens both panels with the tools.
    wanted_ = rememberedFlag(settings, "controls").value_or(false);
    parts_.table.setVisible(rememberedFlag(settings, "table").value_or(false));
    parts_.tools.tool(ScopeTool::Table).setChecked(!parts_.table.isHidden());
    fitControls();
}

}  // namespace tacto::gui

#include "moc_ScopeColumns.cpp"
