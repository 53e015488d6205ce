#include "app/gui/runner/ProcedurePages.h"

#include <QScrollArea>

#include "app/gui/calibrate/CertificatePart.h"
#include "app/gui/calibrate/WiringPage.h"
#include "app/gui/runner/NotesPanel.h"
#include "app/gui/runner/RunViews.h"
#include "app/gui/runner/SignPage.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/runner/WorstPage.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/FieldForm.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "core/kinds/ResultKinds.h"

namespace tacto::gui {

namespace {

constexpr int kPageSide = 16, kPageTop = 8;
constexpr int kFormWidth = 400;         // pixels; wide enough for a label and its value
constexpr int kMinScrolledHeight = 96;  // pixels for one field and its title
constexpr int kColumnsFromChars = 88;   // width in characters from which there are two columns

enum PageIndex { kWiringPage, kReferencePage, kSettingsPage, kRunPage, kSignPage };

int pageOf(Step step) {
    switch (step) {
        case kWiring:
            return kWiringPage;
        case kReference:
            return kReferencePage;
        case kSettings:
            return kSettingsPage;
        case kRun:
        case kResult:
            return kRunPage;
        case kSign:
            return kSignPage;
    }
    return kSettingsPage;
}

QScrollArea* dressed(QScrollArea* area) {
    area->setFocusPolicy(Qt::NoFocus);
    area->setMinimumHeight(scaledPx(kMinScrolledHeight));
    onFontChange(*area, [area] { area->setMinimumHeight(scaledPx(kMinScrolledHeight)); });
    for (auto* ground : {area->widget(), area->viewport()}) ground->setAutoFillBackground(false);
    return area;
}

/// Returns a scroll area that scrolls vertically only.
QScrollArea* scrolling(QWidget* part, QWidget* parent) { return dressed(scrollingRows(part, parent)); }

QVBoxLayout* pageLayout(QWidget* page, const QString& title, const QString& about) {
    auto* column = columnIn(*page, -1, {kPageSide, kPageTop, kPageSide, kPageTop});
    if (!title.isEmpty()) {
        column->addWidget(makeLabel(title, {.size = TextSize::Large}, page));
    }
    if (about.isEmpty()) return column;
    column->addWidget(makeLabel(about, {.tone = Tone::Quiet, .wraps = true}, page));
    return column;
}

/// Returns `part` in a column that is no wider than a form needs.
QWidget* formColumn(QWidget* part) {
    auto* body = new QWidget;
    auto* column = columnIn(*body, -1, {0, 0, 12, 0});
    auto* bounded = new QHBoxLayout;  // in a column of its own, its height would be computed for a wrong width
    bounded->addWidget(part, 1);
    bounded->addStretch();
    column->addLayout(bounded);
    column->addStretch();
    return body;
}

}  // namespace

ProcedurePages::ProcedurePages(DayNotes& day, QWidget* parent) : PageStack(parent) {
    form_ = new FieldForm(this);
    addWidget(buildWiring());
    addWidget(buildReference());
    addWidget(buildSettings(day));
    views_ = new RunViews(this);
    addWidget(views_);
    auto* sign = new QWidget(this);
    auto* signColumn = pageLayout(sign, tr("Sign"), {});
    sign_ = new SignPage(sign);
    signColumn->addWidget(sign_, 1);
    addWidget(sign);
    showStep(kSettings);
}

/// Side by side, the second part gets more of the width; stacked, the first part gets more of the height.
QBoxLayout* ProcedurePages::turning() {
    auto* row = new TurningRow([this] { return fontMetrics().averageCharWidth() * kColumnsFromChars - 2 * kPageSide; });
    row->setSpacing(kPageSide);
    connect(row, &TurningRow::turned, this, [row](bool beside) {
        row->setStretch(0, beside ? 2 : 3);
        row->setStretch(1, beside ? 3 : 2);
    });
    return row;
}

QWidget* ProcedurePages::buildWiring() {
    auto* page = new QWidget(this);
    auto* column = pageLayout(page, tr("Wiring"), {});
    auto* row = turning();
    wiring_ = new WiringPanel(page);
    auto* devices = scrolling(formColumn(wiring_), page);
    drawing_ = new WiringPage(page);
    row->addWidget(devices, 2);
    row->addWidget(drawing_, 3);
    column->addLayout(row, 1);
    return page;
}

QWidget* ProcedurePages::buildReference() {
    auto* page = new QWidget(this);
    auto* column = pageLayout(page, tr("Known reference"),
                              tr("It is read first. If the known load reads wrong, nothing else can be judged, so the "
                                 "run stops."));
    boundWidth(form_->referencePart(), kFormWidth * 3 / 2);
    form_->referencePart().show();
    column->addWidget(scrolling(formColumn(&form_->referencePart()), page), 1);
    return page;
}

QWidget* ProcedurePages::buildSettings(DayNotes& day) {
    auto* page = new QWidget(this);
    auto* column = pageLayout(page, tr("Settings"), {});
    auto* row = turning();
    auto* parts = new QWidget;
    boundWidth(*parts, kFormWidth * 3 / 2);
    auto* below = columnIn(*parts);
    certificate_ = new CertificatePart(parts);  // at the top, because it is overlooked below a long form
    below->addWidget(certificate_);
    below->addWidget(form_);
    notes_ = new NotesPanel(day, parts);
    below->addWidget(notes_);
    auto* fields = dressed(scrollingRows(formColumn(parts), page));
    worst_ = new WorstPage(page);
    row->addWidget(fields, 2);
    row->addWidget(worst_, 3);
    column->addLayout(row, 1);
    return page;
}

void ProcedurePages::offer(const ProtocolDeclaration& declaration) {
    wiring_->show(declaration);
    form_->show(declaration);
    const bool drives = declaration.needs.contains(Role::Stimulator);
    certificate_->setVisible(resultTraits(declaration.kind).kind == ResultKind::StimulatorCalibration);
    drawing_->setVisible(drives && declaration.needs.contains(Role::Oscilloscope));
    worst_->setVisible(drives);  // without a stimulator nothing is judged
}

void ProcedurePages::showStep(Step step) {
    setCurrentIndex(pageOf(step));
    if (step == kRun || step == kResult) views_->showResult(step == kResult);
}

void ProcedurePages::setChangeable(bool changeable) {
    for (QWidget* part : {static_cast<QWidget*>(form_), &form_->referencePart(), static_cast<QWidget*>(wiring_),
                          static_cast<QWidget*>(notes_), static_cast<QWidget*>(certificate_)})
        part->setEnabled(changeable);
}

}  // namespace tacto::gui

#include "moc_ProcedurePages.cpp"
