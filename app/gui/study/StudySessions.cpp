#include "app/gui/study/StudySessions.h"

#include <QDateTime>
#include <QHBoxLayout>
#include <QHeaderView>
#include <utility>

#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/results/ResultKind.h"

namespace tacto::gui {

namespace {

using nlohmann::json;

QString stateWords(StudySessionState state) {
    switch (state) {
        case StudySessionState::Unfinished:
            return QObject::tr("interrupted, can continue");
        case StudySessionState::Complete:
            return QObject::tr("complete");
        case StudySessionState::Stopped:
            break;
    }
    return QObject::tr("ended before its end");
}

QString protocolWords(const std::string& protocol) {
    switch (resultTraits(protocol).kind) {
        case ResultKind::PilotIdentification:
            return QObject::tr("identification");
        case ResultKind::PilotThresholds:
            return QObject::tr("thresholds");
        default:
            return qtext(protocol);
    }
}

std::string localText(std::chrono::sys_seconds at) {
    return QDateTime::fromSecsSinceEpoch(at.time_since_epoch().count()).toString("yyyy-MM-dd HH:mm").toStdString();
}

/// {code, number, protocol, state, answered, begun}.
json sessionRows(const std::vector<StudySession>& sessions) {
    auto rows = json::array();
    for (const auto& one : sessions)
        rows.push_back({{"code", one.code.empty() ? json() : json(namedWith(one.basis, one.code))},
                        {"number", one.number},
                        {"protocol", protocolWords(one.protocol).toStdString()},
                        {"state", stateWords(one.state).toStdString()},
                        {"answered", one.answered},
                        {"begun", localText(one.parts.front().begun)}});
    return rows;
}

}  // namespace

StudySessions::StudySessions(QWidget* parent)
    : QWidget(parent),
      column_(new QVBoxLayout(this)),
      foot_(new QWidget(this)),
      result_(new QPushButton(tr("Show result"), foot_)) {
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(8);
    auto* title = new QLabel(tr("Sessions"), this);
    setTextSize(*title, TextSize::Body, true);
    column_->addWidget(title);
    auto* row = new QHBoxLayout(foot_);
    row->setContentsMargins(0, 0, 0, 0);
    result_->setObjectName("showResult");
    result_->setAutoDefault(false);
    row->addWidget(result_);
    row->addStretch();
    column_->addWidget(foot_);
    connect(result_, &QPushButton::clicked, this, [this] {
        if (const auto* one = chosen()) emit resultWanted(qtext(one->id));
    });
    judge();
}

void StudySessions::show(const Study& study) {
    sessions_ = study.sessions();
    delete std::exchange(table_, nullptr);
    table_ = makeRecordTable({{"Participant", "code"},
                              {"Session", "number", ResultColumn::As::Number},
                              {"Begun", "begun"},
                              {"Protocol", "protocol"},
                              {"Answers", "answered", ResultColumn::As::Number},
                              {"State", "state"}},
                             sessionRows(sessions_), this);
    table_->setObjectName("studySessions");
    table_->setAccessibleName(tr("Sessions"));
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setFocusPolicy(Qt::StrongFocus);
    column_->insertWidget(1, table_);
    setTabOrder(table_, result_);
    connect(table_, &QTableWidget::cellActivated, result_, [this] { result_->click(); });
    layOut(room_);
    const auto known = std::ranges::find(sessions_, id_, &StudySession::id);
    connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
        const auto rows = table_->selectionModel()->selectedRows();
        id_ = rows.isEmpty() ? std::string() : sessions_.at(std::size_t(rows.front().row())).id;
        judge();
    });
    if (!sessions_.empty())
        table_->selectRow(known == sessions_.end() ? table_->rowCount() - 1 : int(known - sessions_.begin()));
    setVisible(!sessions_.empty());
    judge();
}

void StudySessions::setReadable(bool readable) {
    readable_ = readable;
    judge();
}

void StudySessions::layOut(int room_px) {
    room_ = room_px;
    if (table_ == nullptr) return;
    table_->ensurePolished();
    table_->horizontalHeader()->ensurePolished();
    layOutRecordTable(*table_, room_px);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
}

const StudySession* StudySessions::chosen() const {
    const auto found = std::ranges::find(sessions_, id_, &StudySession::id);
    return found == sessions_.end() ? nullptr : &*found;
}

void StudySessions::judge() {
    const auto* one = chosen();
    const bool complete = one != nullptr && one->state == StudySessionState::Complete;
    result_->setEnabled(readable_ && complete);
    result_->setToolTip(complete ? tr("What the selected session came to, read from its record.")
                                 : tr("Select a session that is complete: only those have a result."));
}

}  // namespace tacto::gui

#include "moc_StudySessions.cpp"
