#include "app/gui/runner/ProtocolWorkspace.h"

#include <QApplication>
#include <QFileInfo>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/calibrate/CertificatePart.h"
#include "app/gui/runner/ProcedurePath.h"
#include "app/gui/runner/PromptPanel.h"
#include "app/gui/runner/ProtocolHead.h"
#include "app/gui/runner/ReportView.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/RunViews.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/runner/SignPage.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/runner/WorstPage.h"
#include "app/gui/theme/FieldForm.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/TableContent.h"
#include "core/base/JsonText.h"

namespace tacto::gui {

namespace {

constexpr int kPreviewAfter_ms = 150;

}  // namespace

ProtocolWorkspace::ProtocolWorkspace(BenchController& controller, const QString& protocol, QWidget* parent)
    : QWidget(parent),
      controller_(controller),
      fixed_(protocol),
      layout_(new QBoxLayout(QBoxLayout::LeftToRight, this)),
      reading_([this](const auto& source, const auto& declaration) { declared(source, declaration); }) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(0);
    path_ = new ProcedurePath(fixed_.isEmpty(), this);
    head_ = &path_->head();
    steps_ = &path_->steps();
    panel_ = &path_->panel();
    layout_->addWidget(path_);
    edge_ = new QFrame(this);
    edge_->setForegroundRole(QPalette::Mid);
    layout_->addWidget(edge_);
    auto* column = new QVBoxLayout;
    prompt_ = new PromptPanel(controller_.windowOperator(), this);
    column->addWidget(prompt_);
    pages_ = new ProcedurePages(controller_.day(), this);
    column->addWidget(pages_, 1);
    layout_->addLayout(column, 1);
    arrange();
    connectPath();
    connectPages();
    // Works wherever the focus is, since only one workspace of a window is visible.
    auto* runs = new QShortcut(Qt::Key_F5, this, nullptr, nullptr, Qt::WindowShortcut);
    connect(runs, &QShortcut::activated, this, &ProtocolWorkspace::runAsked);
    connect(&controller_, &BenchController::finished, this, &ProtocolWorkspace::ended);
    connect(&controller_, &BenchController::changed, this, [this] {
        if (asked_.waits()) withdraw();  // the answer was valid only for the earlier profile and bench
        previewLater_.start();
        const auto open = controller_.open();
        showBench();
        if (running_ && open) pages_->views().setDevices(open->about.devices, open->simulated());
    });
    connect(&controller_.windowOperator(), &WindowOperator::asked, this, [this](const OperatorQuestion& question) {
        if (!running_) return;  // another workspace runs it
        prompt_->ask(question);
        QApplication::alert(window());
        emit attentionWanted();
    });
    connect(&controller_.windowOperator(), &WindowOperator::closed, prompt_, &PromptPanel::close);
    previewLater_.setSingleShot(true);
    previewLater_.setInterval(kPreviewAfter_ms);
    connect(&previewLater_, &QTimer::timeout, this, &ProtocolWorkspace::preview);
    fillChooser({});
    onFontChange(*this, [this] { arrange(); });
    onEvent(*this, QEvent::Resize, [this] { arrange(); });
}

void ProtocolWorkspace::arrange() {
    const auto* parent = parentWidget();
    while (parent != nullptr && qobject_cast<const ScrollingPage*>(parent) == nullptr) parent = parent->parentWidget();
    const auto* page = static_cast<const ScrollingPage*>(parent);
    const int high = page == nullptr ? height() : page->viewport()->height();
    const bool across = path_->fit({widthInSight(*this), high});
    layout_->setDirection(across ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
    edge_->setFrameShape(across ? QFrame::HLine : QFrame::VLine);
}

void ProtocolWorkspace::showPlotOnly(bool only) {
    plotOnly_ = only;
    showPath();
}

void ProtocolWorkspace::showPath() {
    const bool shown = !plotOnly_ || panel_->speaks();
    if (shown == !path_->isHidden()) return;
    // Moves the focus here, so that it does not pass to a text field, in which Space would not stop the output.
    const bool hadFocus = path_->isAncestorOf(QApplication::focusWidget());
    path_->setVisible(shown);
    edge_->setVisible(shown);
    if (!shown && hadFocus) pages_->setFocus();
}

void ProtocolWorkspace::connectPath() {
    connect(head_, &ProtocolHead::chosen, this, &ProtocolWorkspace::choose);
    connect(head_, &ProtocolHead::editWanted, this, [this] { edit(source_, 0, {}); });
    connect(head_, &ProtocolHead::newWanted, this, [this] { edit({}, 0, {}); });
    connect(steps_, &StepList::chosen, this, [this](int step) { goTo(Step(step)); });
    connect(panel_, &RunPanel::runWanted, this, &ProtocolWorkspace::runAsked);
    connect(panel_, &RunPanel::confirmed, this, &ProtocolWorkspace::runNow);
    connect(panel_, &RunPanel::lineWanted, this, [this](int line, const QString& why) { edit(source_, line, why); });
    connect(panel_, &RunPanel::openAgainWanted, &controller_, &BenchController::openAgain);
    connect(panel_, &RunPanel::profileChangeWanted, this, &ProtocolWorkspace::profileChangeWanted);
}

void ProtocolWorkspace::connectPages() {
    connect(&pages_->form(), &FieldForm::edited, this, &ProtocolWorkspace::judge);
    pages_->wiring().checkWith([this](const std::vector<DeviceUri>& uris) { return controller_.allVirtual(uris); });
    connect(&pages_->wiring(), &WiringPanel::edited, this, [this] {
        judge();
        showBench();
    });
    connect(&pages_->views(), &RunViews::scriptErrorChosen, this,
            [this](int line, const QString& why) { edit(source_, line, why); });
    connect(&pages_->views(), &RunViews::plotOnlyWanted, this, &ProtocolWorkspace::plotOnlyWanted);
    connect(&pages_->views(), &RunViews::nextChosen, this, &ProtocolWorkspace::goOn);
    connect(&pages_->views(), &RunViews::reportMenuWanted, &pages_->sign(), &SignPage::offerActs);
    connect(&pages_->sign(), &SignPage::stateChanged, this, [this] {
        steps_->setNote(kSign, pages_->sign().note());
        steps_->setState(kSign, pages_->sign().isSigned() ? StepList::State::Done : StepList::State::ToDo);
        if (wantsReport_) showReport();
    });
    connect(&pages_->sign(), &SignPage::settingsWanted, this, [this] { goTo(kSettings); });
}

void ProtocolWorkspace::fillChooser(const QString& select) {
    if (!head_->chooses()) return choose(fixed_);
    if (!head_->fill(select)) panel_->say(tr("No protocol was found. Write one: New…"));
}

void ProtocolWorkspace::choose(const QString& nameOrPath) {
    declaration_.reset();
    asked_.withdraw();
    seen_.clear();
    showButtons();
    auto source = ProtocolLibrary().find(nameOrPath.toStdString());
    if (!source) return panel_->say(sentence(source.error()));
    source_ = std::move(*source);
    reading_.read(source_);
}

void ProtocolWorkspace::declared(const ProtocolSource& source, const Result<ProtocolDeclaration>& declaration) {
    if (source.name != source_.name || running_) return;
    // The form is rebuilt: if a field had the focus, a field gets it again, so that keys still reach the workspace.
    const bool wasInForm = pages_->form().isAncestorOf(QApplication::focusWidget());
    last_.reset();
    pages_->sign().clear();
    if (!declaration) {
        pages_->offer({});
        head_->show(QString::fromStdString(source.name), {});
        const auto why = QString::fromStdString(declaration.error().message);
        panel_->say(why + tr(" Fix this before running."), lineOf(why));
    } else {
        declaration_ = *declaration;
        panel_->say({});
        head_->show(QString::fromStdString(declaration_->title), QString::fromStdString(declaration_->purpose));
        pages_->views().showPlot(declaration_->view);
        pages_->offer(*declaration_);
    }
    path_->showNoRun(pages_->form().hasReference());
    showBench();  // it may have been opened before this page was made
    // Keeps a step before the run if it was chosen while the script was read; a result belongs to the old protocol.
    const auto chosen = Step(steps_->shown());
    const bool stays = !seen_.empty() && (chosen == kWiring || (chosen == kReference && pages_->form().hasReference()));
    const auto step = stays ? chosen : kSettings;
    seen_.clear();
    showStep(step);
    judge();
    showButtons();
    if (wasInForm) QTimer::singleShot(0, this, [this, step] { goTo(step); });
    if (declaration_) emit declaredAnew();
}

void ProtocolWorkspace::propose(const std::string& parameter, const QString& text) {
    if (!running_) pages_->form().propose(parameter, text);
}

void ProtocolWorkspace::showStep(Step step) {
    pages_->showStep(step);
    steps_->setShown(step);
    path_->showLegend(step == kResult && pages_->views().showsLimits());
    seen_.insert(step);
    showSetup();
}

void ProtocolWorkspace::goTo(Step step) {
    showStep(step);
    if (step == kSign) return steps_->focusShown();  // in the field for the name Space would not stop
    if (step != kWiring && step != kReference && step != kSettings) return;
    for (auto* area : pages_->currentWidget()->findChildren<QScrollArea*>()) area->verticalScrollBar()->setValue(0);
    if (auto* first = pages_->currentWidget()->findChild<QLineEdit*>())
        first->setFocus();
    else
        panel_->setFocus();
}

void ProtocolWorkspace::judge() {
    showSetup();
    withdraw();
    const auto wrong = refusal();
    if (std::exchange(refused_, !wrong.isEmpty()) || refused_)
        setObstacle(wrong, false);
    else
        panel_->setReady(declaration_.has_value(), obstacle_, byProfile_);
    previewLater_.start();
}

void ProtocolWorkspace::showSetup() {
    path_->showSetup(pages_->form(), pages_->wiring(), declaration_.has_value(), running_ || last_ != nullptr, seen_);
}

/// Withdraws the question, as settings or profile have changed since.
void ProtocolWorkspace::withdraw() {
    asked_.withdraw();
    panel_->withdrawQuestion();
}

QString ProtocolWorkspace::refusal() const {
    if (auto wrong = pages_->form().refusal(); !wrong.isEmpty() || !declaration_) return wrong;
    return pages_->wiring().refused();
}

/// A run would end without any result if the safety gate refuses its strongest command, or if an answer that the
/// verdict needs is missing.
void ProtocolWorkspace::setObstacle(const QString& why, bool byProfile) {
    obstacle_ = why;
    byProfile_ = byProfile;
    panel_->setReady(declaration_.has_value(), obstacle_, byProfile_);
    emit readyChanged();
}

void ProtocolWorkspace::preview() {
    previewLater_.stop();
    const auto& area = controller_.profile().electrodeArea;
    pages_->form().setKnown(area ? std::set<std::string>{"area"} : std::set<std::string>{});
    const bool drives = declaration_ && declaration_->needs.contains(Role::Stimulator);
    const auto refused = pages_->worst().judge(controller_, pages_->form().read(), drives);
    auto wrong = refusal();
    if (wrong.isEmpty()) wrong = pages_->form().unanswered();
    setObstacle(wrong.isEmpty() ? refused : wrong, wrong.isEmpty());
}

Result<RunOrder> ProtocolWorkspace::order() {
    if (!declaration_) return fail(ErrorCode::InvalidArgument, "there is no protocol to run");
    auto settings = pages_->form().read();
    if (!settings) return failure(settings);
    auto order = controller_.orderOf(source_, *declaration_, std::move(*settings));
    auto& electrode = order.profile.electrode;
    if (const auto name = pages_->form().electrode(); name && (!electrode || qtext(electrode->name) != *name)) {
        electrode.reset();  // the profile describes another one
        if (!name->isEmpty()) electrode.emplace().name = name->toStdString();
    }
    if (auto filled = pages_->wiring().fill(order); !filled) return failure(filled);
    pages_->certificate().fill(order);
    return order;
}

void ProtocolWorkspace::runAsked() { ask(false); }

void ProtocolWorkspace::ask(bool resetFault) {
    if (running_ || !declaration_) return;
    if (anotherRuns()) return panel_->say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    auto asked = order();
    if (!asked) {
        const auto wrong = refusal();
        wrong.isEmpty() ? panel_->say(sentence(asked.error())) : setObstacle(wrong, false);
        const bool inWiring = !pages_->wiring().refused().isEmpty();
        const auto part = pages_->form().goToRefused();
        if (part || inWiring) showStep(part ? (*part ? kReference : kSettings) : kWiring);
        return;
    }
    if (controller_.day().asksFirst()) return panel_->say(DayNotes::wantedText());
    preview();  // judges the present settings, not earlier ones
    if (!obstacle_.isEmpty()) {
        if (const auto part = pages_->form().goToRefused()) showStep(*part ? kReference : kSettings);
        return;
    }
    const auto harmless = controller_.allVirtual(asked->uris);
    if (!harmless) return panel_->say(tr("%1 Nothing was opened.").arg(sentence(harmless.error())));
    // The operator acknowledges the fault of the last run; the devices that open may have one that was not seen.
    if (resetFault) asked->faultSeen = last_->result.leftIn;
    asked->resetFault = resetFault;
    asked_.ask(std::move(*asked), controller_.mark());
    if (*harmless) return runNow();
    panel_->say({});
    const auto current = tr("This run puts out current on hardware, into a load declared as %1. Is exactly that "
                            "connected, and no person?")
                             .arg(QString::fromStdString(declaredLoad(asked_.order().settings.parameters)));
    if (!resetFault) return panel_->askToArm(current);
    const auto& fault = *last_->result.leftIn;
    panel_->askToArm(tr("The fault is reset first, of %1: %2 Is its cause gone? %3")
                         .arg(qtext(fault.unit), sentence(qtext(fault.reason)), current));
}

/// True also while another run is just ending; its last messages are not for this page.
bool ProtocolWorkspace::anotherRuns() const {
    return controller_.activity() != Activity::Closed && controller_.activity() != Activity::Live;
}

void ProtocolWorkspace::runNow() {
    if (running_ || !asked_.waits()) return;
    if (anotherRuns()) return panel_->say(tr("Another protocol is running. Wait for its end or stop it (Esc)."));
    if (asked_.isVoid(controller_))
        return panel_->say(tr("The question was answered after a stop or after 30 s. Press Run again."));
    running_ = true;
    last_.reset();
    wantsReport_ = false;
    pages_->views().begin(declaration_->view, QString::fromStdString(declaration_->title),
                          asked_.order().settings.parameters);
    pages_->sign().clear();
    path_->showRun();
    showStep(kRun);
    showButtons();
    run_ = asked_.start(controller_);
}

void ProtocolWorkspace::refresh() {
    showPath();
    if (!running_) return;
    const auto feed = controller_.takeRunFeed();
    pages_->views().take(feed);
    if (!feed.captures.empty()) emit captured(feed.captures.back());
    if (feed.progress) steps_->setNote(kRun, tr("%1 of %2").arg(feed.progress->done).arg(feed.progress->total));
    panel_->show(feed.progress ? &*feed.progress : nullptr, controller_.paused(), prompt_->open());
}

void ProtocolWorkspace::ended(const std::shared_ptr<const FinishedRun>& run) {
    if (!running_ || run->number != run_) return;  // a run of another page
    refresh();
    running_ = false;
    last_ = run;
    prompt_->close();
    const auto& error = run->result.outcome.error;
    const bool watched = panel_->isAncestorOf(QApplication::focusWidget());
    path_->showEnd(error.has_value(), run->benchTime);
    if (const auto odd = pages_->views().end(*run); !odd.isEmpty()) panel_->say(odd);
    pages_->sign().show(*run);
    showBench();
    steps_->setNote(kResult, pages_->views().word());
    showStep(kResult);
    showButtons();
    if (watched) steps_->focusShown();  // the progress bar had the focus, and is hidden now
    if (auto& certificate = pages_->certificate();
        !error && !certificate.isHidden() && pages_->form().text("mode") != "check")
        certificate.forget();
    if (!error) return;
    if (run->result.session.empty())
        panel_->say(withOutput(inThePast(sentence(withoutScriptPlace(qtext(error->message)))),
                               tr("The output was switched off.")));
    if (editor_ != nullptr && editor_->isVisible() && run->result.outcome.line > 0)
        editor_->showError(run->result.outcome.line, QString::fromStdString(error->message));
}

/// Offers to open the bench again after the run that closed it.
void ProtocolWorkspace::showBench() {
    const auto activity = controller_.activity();
    const auto faulty = [](const auto& uris) { return std::ranges::any_of(uris, simulatesFault); };
    const auto devices = devicesOf(pages_->wiring().devices()).value_or(std::vector<DeviceUri>());
    const auto open = activity != Activity::Live                              ? RunPanel::Open::None
                      : faulty(controller_.liveDevices()) && !faulty(devices) ? RunPanel::Open::WithFaults
                                                                              : RunPanel::Open::Bench;
    panel_->setBench(open, last_ && activity == Activity::Closed && controller_.closedByRun());
}

void ProtocolWorkspace::goOn(NextStep next) {
    if (!last_) return;
    switch (next) {
        case NextStep::ResetFault:
            return ask(true);
        case NextStep::WithoutFault:
            pages_->wiring().removeFaults();
            return runAsked();
        case NextStep::UseProfile:
            return useProfile();
        case NextStep::Check:
        case NextStep::Calibrate:
            propose("mode", next == NextStep::Check ? "check" : "full");
            return runAsked();
        case NextStep::SafetyCheck:
            emit safetyCheckWanted();
            return;
        case NextStep::Live:
            emit liveWanted();
            return;
        case NextStep::Sign:
            return goTo(kSign);
        case NextStep::Report:
            return showReport();
        case NextStep::Session:
            emit sessionWanted(QString::fromStdString(last_->result.session.string()));
            return;
        case NextStep::ChangeSettings:
            return goTo(kSettings);
    }
}

QString ProtocolWorkspace::report() const { return last_ ? pages_->sign().report() : QString(); }

/// Shows the report, or says what it waits for and shows it once it is drawn.
void ProtocolWorkspace::showReport() {
    const auto& sign = pages_->sign();
    const bool there = !sign.report().isEmpty();
    wantsReport_ = !there && sign.drawing();
    if (there) ReportWindow::showReport(*this, sign.report(), qtext(last_->result.session.string()));
    panel_->say(there ? QString() : sign.note());
}

/// The bench checks this profile like any other: it refuses an unsuitable one, and failed() says why.
void ProtocolWorkspace::useProfile() {
    const auto& made = memberAt(last_->result.outcome.results, "profile.profile");
    const auto profile = parseProfile(dumpJson(made), "the profile of this result");
    if (!profile) return panel_->say(sentence(profile.error()));
    controller_.setProfile(*profile);
    steps_->setNote(kResult, tr("profile in use"));
}

void ProtocolWorkspace::showButtons() {
    panel_->setReady(declaration_.has_value(), obstacle_, byProfile_);
    pages_->setChangeable(!running_);
    head_->setChangeable(!running_);
}

QWidget& ProtocolWorkspace::plotKind() { return pages_->views().plotKind(); }

ScriptEditor* ProtocolWorkspace::unsavedScript() const {
    return editor_ != nullptr && editor_->unsaved() ? editor_ : nullptr;
}

void ProtocolWorkspace::edit(const ProtocolSource& source, int line, const QString& why) {
    if (editor_ == nullptr) {
        editor_ = new ScriptEditor(controller_, this);
        connect(editor_, &ScriptEditor::saved, this, &ProtocolWorkspace::saved);
        connect(editor_, &ScriptEditor::runRequested, this, [this](const QString& path) {
            editor_->hide();
            window()->activateWindow();
            saved(path);
            goTo(kSettings);
        });
    }
    editor_->edit(source);
    if (line > 0) editor_->showError(line, why);
}

void ProtocolWorkspace::saved(const QString& path) {
    if (running_) return;  // the file is read at the next choice
    const auto name = QFileInfo(path).completeBaseName();
    if (head_->chooses() || name == fixed_) fillChooser(name);
}

}  // namespace tacto::gui

#include "moc_ProtocolWorkspace.cpp"
