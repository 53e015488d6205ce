#include "app/gui/sessions/SessionOverview.h"

#include <QEvent>
#include <QGridLayout>
#include <QSplitter>
#include <QTimer>

#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"
#include "core/session/SessionLabels.h"

namespace tacto::gui {

namespace {

constexpr int kGrid = 8;
constexpr int kHeadIcon = 32;
constexpr int kShownMoments = 500;
constexpr int kMinMoments = 3;  // number of lines
constexpr int kMinNote = 16;    // number of characters
constexpr int kWhyLines = 2;
constexpr int kLowPage = 560;      // height below which the reason takes one line
constexpr double kWrapped = 0.85;  // used share of a line's width when words wrap

SessionEntry entryOf(const ReadSession& session) {
    ListedSession listed;
    listed.path = session.path;
    listed.summary.closed = session.closed;
    listed.summary.wallStart = session.about.wallStart;
    if (!session.verdicts.empty()) listed.summary.verdict = session.verdicts.back().verdict;
    listed.summary.faulted =
        std::ranges::any_of(session.events, [](const auto& event) { return event.name == "fault"; });
    return SessionEntry(std::move(listed));
}

}  // namespace

SessionOverview::SessionOverview(QWidget* parent)
    : QWidget(parent), content_(new QWidget(this)), nothing_(new QLabel(this)) {
    auto* page = columnIn(*this);
    nothing_->setWordWrap(true);
    nothing_->setAlignment(Qt::AlignCenter);
    nothing_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    setTone(*nothing_, Tone::Quiet);
    page->addWidget(nothing_, 1);
    page->addWidget(content_, 1);
    auto* column = columnIn(*content_, kGrid, {2 * kGrid, kGrid, 2 * kGrid, kGrid});
    column->addWidget(buildHead());
    column->addWidget(buildFields());
    auto* split = new QSplitter(Qt::Vertical, content_);
    split->setChildrenCollapsible(false);
    preview_ = new SessionPreview(split);
    split->addWidget(preview_);
    split->addWidget(buildHappened());
    split->setStretchFactor(0, 3);
    split->setStretchFactor(1, 2);
    split->setSizes({10'000, 1});  // the plot takes the remaining space
    column->addWidget(split, 1);
    say(tr("Choose a session at the left."));
    onEvent(*this, QEvent::Resize, [this] {
        if (session_) QTimer::singleShot(0, this, &SessionOverview::fitWhy);  // once the head has its width
    });
}

QWidget* SessionOverview::buildHead() {
    auto* head = new QWidget(content_);
    auto* grid = layoutIn<QGridLayout>(*head, -1, {});
    grid->setHorizontalSpacing(kGrid);
    grid->setVerticalSpacing(0);
    icon_ = new QLabel(head);
    title_ = makeLabel({}, {.name = "sessionTitle", .size = TextSize::Large, .strong = true, .wraps = true}, head);
    why_ = makeLabel({}, {.name = "sessionWhy", .wraps = true, .selectable = true}, head);
    grid->addWidget(icon_, 0, 0, 2, 1, Qt::AlignTop);
    grid->addWidget(title_, 0, 1);
    grid->addWidget(why_, 1, 1);
    grid->setColumnStretch(1, 1);
    return head;
}

QWidget* SessionOverview::buildHappened() {
    auto* holder = new QWidget(content_);
    auto* column = columnIn(*holder, kGrid / 2, {0, kGrid, 0, 0});
    column->addWidget(strongLabel(tr("What happened"), holder));
    happened_ = new QTextBrowser(holder);
    happened_->document()->setDocumentMargin(0);
    nameWidget(*happened_, "whatHappened", tr("What happened"));
    happened_->setTabChangesFocus(true);
    const auto least = [this] { happened_->setMinimumHeight(happened_->fontMetrics().height() * kMinMoments); };
    least();
    onFontChange(*happened_, least);
    column->addWidget(happened_, 1);
    return holder;
}

QWidget* SessionOverview::buildFields() {
    auto* fields = new QWidget(content_);
    auto* grid = layoutIn<QGridLayout>(*fields, -1, {});
    grid->setHorizontalSpacing(kGrid);
    grid->setVerticalSpacing(kGrid / 2);
    const auto label = [fields](const QString& title) {
        auto* made = makeLabel(title, {.tone = Tone::Quiet, .size = TextSize::Small}, fields);
        return made;
    };
    const auto edit = [this, fields](const QString& title, const char* name, const QString& placeholder,
                                     std::size_t limit) {
        auto* made = new QLineEdit(fields);
        nameWidget(*made, name, title);
        made->setPlaceholderText(placeholder);
        made->setMaxLength(int(limit));
        connect(made, &QLineEdit::editingFinished, this, &SessionOverview::save);
        return made;
    };
    operator_ = edit(tr("Operator"), "labelOperator", tr("not recorded"), kLabelLimit);
    sample_ = edit(tr("Sample"), "labelSample", tr("not recorded"), kLabelLimit);
    tags_ = edit(tr("Tags"), "labelTags", tr("P60, P120"), kMaxTags * (kTagLimit + 2));
    note_ = edit(tr("Note"), "labelNote", tr("what the next reader should know"), kSessionNoteLimit);
    int at = 0;
    for (auto* one : {operator_, sample_, tags_}) {
        grid->addWidget(label(one->accessibleName()), 0, at);
        grid->addWidget(one, 1, at++);
    }
    // Next to the note, so that it takes no space from the plot. A long sentence leaves some room for the note.
    saved_ = makeLabel<ElidedLabel>({}, {.name = "labelsSaved"}, fields);
    saved_->hide();
    setTextSize(*saved_, TextSize::Small);
    auto* note = new QHBoxLayout;
    note->setSpacing(kGrid);
    note->addWidget(label(note_->accessibleName()));
    note->addWidget(note_, 1);
    note->addWidget(saved_);
    const auto least = [this] { note_->setMinimumWidth(note_->fontMetrics().averageCharWidth() * kMinNote); };
    least();
    onFontChange(*note_, least);
    grid->addLayout(note, 2, 0, 1, 3);
    for (int column = 0; column < 3; ++column) grid->setColumnStretch(column, column == 2 ? 3 : 2);
    return fields;
}

void SessionOverview::say(const QString& why) {
    save();
    session_.reset();
    nothing_->setText(why);
    nothing_->show();
    content_->hide();
}

void SessionOverview::show(std::shared_ptr<const ReadSession> session) {
    save();
    session_ = std::move(session);
    kept_ = session_->labels;
    refused_.clear();
    pending_ = 0;
    nothing_->hide();
    content_->show();
    showFields();
    preview_->show(*session_);
    layout()->activate();
    showHead();
    showHappened();
    QTimer::singleShot(0, this, &SessionOverview::fitWhy);  // after the layout has set the head's width
}

void SessionOverview::showHead() {
    const auto ending = endingOf(entryOf(*session_), false);
    icon_->setPixmap(iconPixmap(ending.icon, ending.colour, scaledPx(kHeadIcon), devicePixelRatioF()));
    title_->setText(tr("%1: %2").arg(procedureText(session_->about.protocol), ending.word));
    title_->setToolTip(qtext(session_->path.string()));
    QStringList why;
    if (!session_->verdicts.empty())
        for (const auto& reason : session_->verdicts.back().reasons) why << sentence(withoutScriptPlace(qtext(reason)));
    whole_ = why.isEmpty() ? tr("%1, %2%3.")
                                 .arg(beganText(entryOf(*session_).began), durationText(toSeconds(session_->length)),
                                      session_->about.simulated ? tr(", simulated") : QString())
                           : keptTogether(why.first()).replace("± ", "±\u00a0");
    fitWhy();
    why_->setToolTip(why.join('\n'));
}

/// Elides a long reason, so that the plot below keeps its space; the tool tip shows the whole reason.
void SessionOverview::fitWhy() {
    const bool low = height() < scaledPx(kLowPage);
    const int room = low ? why_->width() - 4 : int(kWhyLines * kWrapped * why_->width());
    why_->setText(why_->fontMetrics().elidedText(whole_, Qt::ElideRight, std::max(room, why_->fontMetrics().height())));
}

void SessionOverview::showFields() {
    showLabels(kept_);
    const bool fixed = !session_->fixed.isEmpty();
    const std::pair<QLineEdit*, QString> all[] = {
        {operator_, tr("Who ran the session, for the report.")},
        {sample_, tr("Your own id of the sample that was measured.")},
        {tags_, tr("Words to find the session by, separated by commas.")},
        {note_, tr("One line. The search covers it, and the report shows it.")}};
    for (const auto& [edit, tip] : all) {
        edit->setReadOnly(fixed);
        edit->setToolTip(fixed ? session_->fixed
                               : tip + tr(" Kept in the session when you press Return or leave the field; what was "
                                          "recorded stays as it is."));
    }
    saySaved(session_->fixed, false);
}

/// A field that already has this text is left unchanged, with its cursor.
void SessionOverview::showLabels(const SessionLabels& labels) {
    QStringList tags;
    for (const auto& tag : labels.tags) tags << qtext(tag);
    const std::pair<QLineEdit*, QString> all[] = {{operator_, qtext(labels.operatorName)},
                                                  {sample_, qtext(labels.sample)},
                                                  {note_, qtext(labels.note)},
                                                  {tags_, tags.join(", ")}};
    const bool sameTags = entered().tags == labels.tags;
    for (const auto& [edit, text] : all) {
        const bool same = edit == tags_ ? sameTags : edit->text().simplified() == text;
        if (!same) edit->setText(text);
    }
}

SessionLabels SessionOverview::entered() const {
    const auto text = [](const QLineEdit* edit) { return edit->text().simplified().toStdString(); };
    SessionLabels labels{text(operator_), text(sample_), text(note_), {}};
    for (const auto& tag : tags_->text().split(',', Qt::SkipEmptyParts))
        if (const auto word = tag.simplified().toStdString();
            !word.empty() && std::ranges::find(labels.tags, word) == labels.tags.end())
            labels.tags.push_back(word);
    return labels;
}

void SessionOverview::save() {
    if (!session_ || !session_->fixed.isEmpty()) return;
    const auto labels = entered();
    if (labels == kept_) return;
    const auto before = std::exchange(kept_, labels);
    refused_.clear();  // the next save tries refused edits again
    ++pending_;
    saySaved(tr("Saving…"), false);
    saves_.start(
        this, [path = session_->path, before, labels] { return saveLabels(path, before, labels); },
        [this, before, labels, session = session_](const Result<SessionLabels>& done) {
            if (done) emit labelsSaved(qtext(session->path.string()));
            if (session_ == session) return saved(before, labels, done);
            if (!done) emit labelsRefused(sentence(done.error()));
        });
}

void SessionOverview::saved(const SessionLabels& before, const SessionLabels& edited,
                            const Result<SessionLabels>& done) {
    --pending_;
    if (!done) {
        takeEdit(edited, before, kept_);  // the next Return tries again
        refused_ = sentence(done.error());
    } else if (pending_ == 0) {
        auto shown = entered();  // accepts changes from elsewhere, but keeps what is being typed
        takeEdit(kept_, *done, shown);
        takeEdit(kept_, entered(), shown);
        kept_ = *done;
        showLabels(shown);
    }
    if (!refused_.isEmpty())
        saySaved(refused_, true);
    else if (pending_ == 0)  // otherwise a later edit is still being saved, and the label says so
        saySaved(tr("Kept in the session."), false);
}

void SessionOverview::saySaved(const QString& text, bool refused) {
    saved_->setText(text);
    saved_->setToolTip(text);
    saved_->setVisible(!text.isEmpty());
    setTone(*saved_, refused ? Tone::Warning : Tone::Quiet);
}

void SessionOverview::showHappened() {
    const auto all = whatHappened(*session_);
    const auto quiet = colours().quiet.name();
    QString html = "<table cellspacing=\"0\" cellpadding=\"2\">";
    int shown = 0;
    for (const auto& moment : all) {
        if (++shown > kShownMoments) break;
        const auto text = moment.text.toHtmlEscaped();
        html += QString("<tr><td style=\"color:%1; white-space:nowrap; padding-right:12px\">%2</td><td>%3</td></tr>")
                    .arg(quiet, moment.when, moment.mark ? "<b>" + text + "</b>" : text);
    }
    html += "</table>";
    if (all.size() > kShownMoments)
        html +=
            "<p>" + tr("%1 more are in the export.").arg(countText(std::size_t(all.size() - kShownMoments))) + "</p>";
    happened_->setHtml(html);
}

/// Saves what was typed when the window closes or another page opens.
void SessionOverview::hideEvent(QHideEvent* event) {
    save();
    QWidget::hideEvent(event);
}

void SessionOverview::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::PaletteChange || !session_ || happened_ == nullptr) return;
    showHead();
    showHappened();
}

}  // namespace tacto::gui

#include "moc_SessionOverview.cpp"
