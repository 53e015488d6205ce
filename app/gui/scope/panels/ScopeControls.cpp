#include "app/gui/scope/panels/ScopeControls.h"

#include <QEvent>
#include <QLabel>
#include <QScrollBar>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

ScopeControls::ScopeControls(ScopeModel& model, ScopeScreen& screen, QWidget* parent) : QScrollArea(parent) {
    setObjectName("scopeControls");
    scrollDownOnly(*this);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    auto* inside = new QWidget(this);
    auto* lanes = new LanePanel(model, screen, inside);
    view_ = new ViewPanel(model, inside);
    acquisition_ = new AcquisitionPanel(inside);
    mask_ = new MaskPanel(inside);
    auto* column = columnIn(*inside, 8, {4, 0, 8, 0});
    for (const auto& [title, panel] :
         std::initializer_list<std::pair<QString, QWidget*>>{{tr("Lanes"), lanes},
                                                             {tr("View"), view_},
                                                             {tr("Trigger and record"), acquisition_},
                                                             {tr("Mask"), mask_}}) {
        column->addWidget(makeLabel(title, {.size = TextSize::Body, .strong = true}, inside));
        column->addWidget(panel);
        column->addSpacing(8);
    }
    column->addStretch();
    setWidget(inside);
}

QSize ScopeControls::sizeHint() const {
    return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(),
            QScrollArea::sizeHint().height()};
}

bool ScopeControls::eventFilter(QObject* watched, QEvent* event) {
    if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(watched, event);
}

void ScopeControls::save(QSettings& settings) const {
    acquisition_->save(settings);
    view_->save(settings);
    mask_->save(settings);
}

void ScopeControls::restore(const QSettings& settings) {
    acquisition_->restore(settings);
    mask_->restore(settings);
    view_->restore(settings);
}

}  // namespace tacto::gui

#include "moc_ScopeControls.cpp"
