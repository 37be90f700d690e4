#include "sessions/import/tables/xml_cutter.h"

#include <expat.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr int kBlockBytes = 64 << 10;
constexpr std::int64_t kMostTagBytes = 1 << 20;  // a tag or a comment, which libexpat keeps whole
constexpr std::size_t kMostDepth = 64;
constexpr std::size_t kMostAttributes = 1024;
constexpr std::size_t kMostElements = 65536;  // of a row
constexpr std::size_t kMostPathBytes = 4096;
constexpr std::size_t kMostValueBytes = 64 << 10;
constexpr std::size_t kMostPlaces = 4096;
constexpr std::size_t kMostOtherElements = 64;

struct PathHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
};

std::string_view without_namespace(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool declares_namespace(std::string_view attribute) {
  return attribute == "xmlns" || attribute.starts_with("xmlns:");
}

struct Fault {
  std::int64_t line = 0;
  std::string problem, remedy;
};

std::string error_remedy(XML_Error error) {
  switch (error) {
    case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
      return "the file holds two documents: split it, or put one element around all";
    case XML_ERROR_UNKNOWN_ENCODING:
      return "save it as UTF-8";
    case XML_ERROR_UNDEFINED_ENTITY:
      return "write the character itself in its place";
    default:
      return "correct the file; what follows is not read";
  }
}

}  // namespace

struct XmlCutter::State {
  State(const std::filesystem::path& name, std::string element, bool learning)
      : file(name), row_element(std::move(element)), learn(learning), parser(XML_ParserCreate(nullptr)) {
    if (parser == nullptr) throw std::bad_alloc();
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, on_start, on_end);
    XML_SetCharacterDataHandler(parser, on_text);
    XML_SetStartDoctypeDeclHandler(parser, on_doctype);
  }
  ~State() { XML_ParserFree(parser); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  static State& of(void* user) { return *static_cast<State*>(user); }
  // libexpat is C: no exception may pass it.
  template <class Action>
  void guarded(const Action& action) {
    try {
      if (!stopped) action();
    } catch (...) {
      thrown = std::current_exception();
      stop_for_good();
    }
  }
  static void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char** attributes) {
    of(user).guarded([&] { of(user).start(without_namespace(name), attributes); });
  }
  static void XMLCALL on_end(void* user, const XML_Char*) {
    of(user).guarded([&] { of(user).end(); });
  }
  static void XMLCALL on_text(void* user, const XML_Char* text, int bytes) {
    of(user).guarded([&] { of(user).add_text({text, static_cast<std::size_t>(bytes)}); });
  }
  static void XMLCALL on_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    of(user).guarded([&] {
      of(user).refuse("declares a document type (<!DOCTYPE ...>), which could define entities",
                      "remove the declaration");
    });
  }

  void stop_for_good() {
    stopped = done = true;
    XML_StopParser(parser, XML_FALSE);
  }
  std::int64_t parser_line() const { return static_cast<std::int64_t>(XML_GetCurrentLineNumber(parser)); }
  // Of the file: nothing after it is read.
  void refuse(const std::string& problem, const std::string& remedy) {
    file_fault = Fault{parser_line(), problem, remedy};
    stop_for_good();
  }
  // Of the row: the first one counts. Who only learns what there is asks for no values.
  void spoil(const std::string& problem, const std::string& remedy) {
    if (!row_fault && !learn) row_fault = Fault{parser_line(), problem, remedy};
  }

  std::optional<std::size_t> find(std::string_view key) {
    const auto found = places.find(key);
    if (found != places.end()) return found->second;
    if (!learn) return std::nullopt;
    if (paths.size() >= kMostPlaces) {
      refuse("has more than " + std::to_string(kMostPlaces) + " kinds of values in a row",
             "name the element of a row in the map");
      return std::nullopt;
    }
    return add_place(std::string(key));
  }
  std::size_t add_place(std::string key) {
    const std::size_t place = paths.size();
    places.emplace(key, place);
    paths.push_back(std::move(key));
    values.emplace_back();
    set.push_back(false);
    return place;
  }
  void set_value(std::size_t place, std::string_view text) {
    if (set[place])
      spoil("element <" + row_element + "> holds " + in_quotes(paths[place]) + " more than once",
            "name the element within it as the row in the map (\"xml\")");
    set[place] = true;
    append(place, text);
  }
  void append(std::size_t place, std::string_view text) {
    if (values[place].size() + text.size() > kMostValueBytes)
      return spoil("the value of " + in_quotes(paths[place]) + " is longer than " +
                       std::to_string(kMostValueBytes) + " bytes",
                   "correct or remove the element");
    values[place].append(text);
  }

  void start(std::string_view name, const XML_Char** attributes) {
    if (++depth > kMostDepth)
      return refuse("has elements more than " + std::to_string(kMostDepth) + " deep", "correct the file");
    if (row_depth == 0) {
      if (name != row_element) return note_other(name);
      begin_row();
    } else {
      open_child(name);
      if (stopped) return;
    }
    std::size_t count = 0;
    const std::size_t bytes = path.size();
    for (; *attributes != nullptr && !stopped; attributes += 2) {
      if (++count > kMostAttributes)
        return refuse("has an element with more than " + std::to_string(kMostAttributes) + " attributes",
                      "correct the file");
      if (declares_namespace(attributes[0])) continue;
      path.append("@").append(without_namespace(attributes[0]));
      if (const auto place = find(path)) set_value(*place, attributes[1]);
      path.resize(bytes);
    }
  }
  void note_other(std::string_view name) {
    if (others.size() < kMostOtherElements && std::find(others.begin(), others.end(), name) == others.end())
      others.emplace_back(name);
  }
  void begin_row() {
    row_depth = depth;
    row_line = parser_line();
    row_fault.reset();
    elements = 0;
    path.clear();
    open.clear();
    for (std::size_t place = 0; place < values.size(); ++place) {
      values[place].clear();
      set[place] = false;
    }
  }
  void open_child(std::string_view name) {
    if (path.size() + name.size() > kMostPathBytes)
      return refuse("has element names of more than " + std::to_string(kMostPathBytes) + " bytes",
                    "correct the file");
    if (++elements > kMostElements)
      return refuse("holds more than " + std::to_string(kMostElements) + " elements in one row",
                    "name the element of a row in the map (\"xml\")");
    open.push_back({path.size(), std::nullopt, false});
    if (!path.empty()) path.append("/");
    path.append(name);
  }
  void add_text(std::string_view text) {
    if (row_depth == 0 || open.empty()) return;
    Child& child = open.back();
    if (!child.place) {
      if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return;
      child.place = find(path);
      if (!child.place) return;
    }
    if (child.has_text) return append(*child.place, text);
    child.has_text = true;
    set_value(*child.place, text);
  }
  void end() {
    --depth;
    if (row_depth == 0) return;
    if (!open.empty()) {
      path.resize(open.back().path_bytes);
      open.pop_back();
      return;
    }
    row_depth = 0;
    row_ready = true;
    row_end = XML_GetCurrentByteIndex(parser) + XML_GetCurrentByteCount(parser);
    XML_StopParser(parser, XML_TRUE);
  }

  void feed();
  void check(XML_Status status);

  InputFile file;
  std::string row_element;
  bool learn;
  XML_Parser parser;
  bool suspended = false, fed_all = false, stopped = false, done = false;
  std::int64_t fed = 0;

  struct Child {
    std::size_t path_bytes;  // of its parent
    std::optional<std::size_t> place;
    bool has_text;
  };
  std::size_t depth = 0, row_depth = 0, elements = 0;
  std::string path;
  std::vector<Child> open;
  std::unordered_map<std::string, std::size_t, PathHash, std::equal_to<>> places;
  std::vector<std::string> paths, values, others;
  std::vector<bool> set;
  bool row_ready = false;
  std::int64_t row_line = 0, row_end = 0;
  std::optional<Fault> row_fault, file_fault;
  std::exception_ptr thrown;
  std::string cut_off;
};

// Goes on by one block, or with the rest of the one in which a row ended.
void XmlCutter::State::feed() {
  if (suspended) {
    suspended = false;
    return check(XML_ResumeParser(parser));
  }
  void* block = XML_GetBuffer(parser, kBlockBytes);
  if (block == nullptr) throw std::bad_alloc();
  const std::size_t got = file.read(static_cast<char*>(block), kBlockBytes);
  fed += static_cast<std::int64_t>(got);
  fed_all = got == 0;
  check(XML_ParseBuffer(parser, static_cast<int>(got), fed_all ? XML_TRUE : XML_FALSE));
}

void XmlCutter::State::check(XML_Status status) {
  if (thrown) std::rethrow_exception(thrown);
  if (file_fault) throw InputError(file.path(), file_fault->line, file_fault->problem, file_fault->remedy);
  suspended = status == XML_STATUS_SUSPENDED;
  if (status == XML_STATUS_ERROR) {
    done = true;
    if (fed_all) {  // it fails only for want of what should follow
      std::string rest(200, '\0');
      rest.resize(file.read_at(row_end, rest.data(), rest.size()));
      const std::size_t first = rest.find_first_not_of(" \t\r\n");
      if (first != std::string::npos) cut_off = rest.substr(first, rest.find_first_of("\r\n", first) - first);
      return;
    }
    const XML_Error error = XML_GetErrorCode(parser);
    throw InputError(file.path(), parser_line(),
                     std::string("is no well-formed XML: ") + XML_ErrorString(error), error_remedy(error));
  }
  if (!suspended && fed_all) done = true;
  if (!suspended && fed - XML_GetCurrentByteIndex(parser) > kMostTagBytes) {
    done = true;
    throw InputError(file.path(), parser_line(),
                     "has a tag or comment of more than " + std::to_string(kMostTagBytes) + " bytes",
                     "correct the file");
  }
}

XmlCutter::XmlCutter(const std::filesystem::path& file, std::string row_element, bool learn)
    : state_(std::make_unique<State>(file, std::move(row_element), learn)) {}

XmlCutter::~XmlCutter() = default;

std::size_t XmlCutter::place(std::string_view path) {
  const auto found = state_->places.find(path);
  return found != state_->places.end() ? found->second : state_->add_place(std::string(path));
}

bool XmlCutter::next() {
  State& state = *state_;
  state.row_ready = false;
  while (!state.row_ready) {
    if (state.done) return false;
    state.feed();
  }
  if (state.row_fault)
    throw InputError(state.file.path(), state.row_fault->line, state.row_fault->problem,
                     state.row_fault->remedy);
  return true;
}

const std::vector<std::string>& XmlCutter::values() const {
  return state_->values;
}
const std::vector<std::string>& XmlCutter::paths() const {
  return state_->paths;
}
std::int64_t XmlCutter::line() const {
  return state_->row_line;
}
std::string XmlCutter::cut_off() const {
  return state_->cut_off;
}
const std::vector<std::string>& XmlCutter::other_elements() const {
  return state_->others;
}

}  // namespace herr
