// What is refused before any page is asked.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/http/http_server.h"
#include "server/http/request_head.h"

namespace herr {
namespace {

int status_of(const std::string& head) {
  return judge_head(head, host_names_for("127.0.0.1")).status;
}

TEST(RequestHead, IsWholeAtTheFirstEmptyLine) {
  const std::string head = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  EXPECT_EQ(head_length(head + "rest"), head.size());
  for (std::size_t cut = 0; cut < head.size(); ++cut)
    EXPECT_EQ(head_length(head.substr(0, cut)), std::nullopt);
}

TEST(RequestHead, AcceptsWhatClientsSend) {
  for (const std::string host : {"127.0.0.1", "localhost:8080", "LOCALHOST", "[::1]:1", "[::1]"}) {
    EXPECT_EQ(status_of("GET /v1/frames?since=3 HTTP/1.1\r\nHost: " + host + "\r\n\r\n"), 0) << host;
  }
  EXPECT_EQ(status_of("GET / HTTP/1.0\r\n\r\n"), 0) << "HTTP/1.0 has no Host";
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\nRange: bytes=0-1\r\n"
                      "Origin: http://localhost:8080\r\nAccept: */*\r\n\r\n"),
            0);
  const RequestHead head = judge_head("HEAD /metrics HTTP/1.1\r\nhost:localhost\r\n\r\n", {"localhost"});
  EXPECT_EQ(head.status, 0);
  EXPECT_TRUE(head.head_only);
  EXPECT_EQ(head.target, "/metrics");
}

TEST(RequestHead, RefusesEachFaultWithItsOwnStatus) {
  const std::string host = "Host: localhost\r\n";
  std::string many;
  for (std::size_t i = 0; i <= kMostHeaders; ++i) many += "a: b\r\n";
  const std::vector<std::pair<std::string, int>> table{
      {"\r\n\r\n", 400},
      {"GET\r\n\r\n", 400},
      {"GET /\r\n\r\n", 400},  // HTTP/0.9
      {"GET  HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET / a HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET http://localhost/ HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET * HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET /\x80 HTTP/1.1\r\n" + host + "\r\n", 400},
      {"PRI * HTTP/2.0\r\n\r\n", 505},
      {std::string("\x16\x03\x01\x02\x00\x01\r\n\r\n", 10), 400},  // TLS on a plain port
      {"GET / HTTP/1.1\r\n\r\n", 400},                             // no Host
      {"GET / HTTP/1.1\r\n" + host + host + "\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "no colon\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "X : y\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + " folded: y\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", 421},
      {"GET / HTTP/1.1\r\nHost: localhost.evil.example\r\n\r\n", 421},
      {"GET / HTTP/1.1\r\nHost: localhost:80x\r\n\r\n", 421},
      {"GET / HTTP/1.1\r\nHost: localhost%0d%0a\r\n\r\n", 421},
      {"GET / HTTP/1.1\r\nHost: \r\n\r\n", 421},
      {"GET / HTTP/1.0\r\nHost: evil.example\r\n\r\n", 421},
      {"GET / HTTP/1.1\r\n" + host + "Origin: https://evil.example\r\n\r\n", 403},
      {"GET / HTTP/1.1\r\n" + host + "Origin: null\r\n\r\n", 403},
      {"POST / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\n", 405},
      {"get / HTTP/1.1\r\n" + host + "\r\n", 405},
      {"CONNECT / HTTP/1.1\r\n" + host + "\r\n", 405},
      {"GET / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\n", 413},
      {"GET / HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n", 413},
      {"GET /" + std::string(kMostTargetBytes, 'a') + " HTTP/1.1\r\n" + host + "\r\n", 414},
      {"GET / HTTP/1.1\r\n" + host + many + "\r\n", 431},
  };
  for (const auto& [head, status] : table) EXPECT_EQ(status_of(head), status) << head.substr(0, 80);
}

TEST(RequestHead, WithATokenNothingIsAnsweredWithoutIt) {
  const std::string token = "abcdefghij-0123456789";
  const auto status = [&](const std::string& lines) {
    return judge_head("GET / HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n", {"localhost"}, token).status;
  };
  EXPECT_EQ(status("Authorization: Bearer " + token + "\r\n"), 0);
  EXPECT_EQ(status("authorization:  bEARER   " + token + " \r\n"), 0);
  // Browsers send "name:password" in base64: "me:abcdefghij-0123456789" and ":abcdefghij-0123456789".
  EXPECT_EQ(status("Authorization: Basic bWU6YWJjZGVmZ2hpai0wMTIzNDU2Nzg5\r\n"), 0);
  EXPECT_EQ(status("Authorization: Basic OmFiY2RlZmdoaWotMDEyMzQ1Njc4OQ==\r\n"), 0);
  for (const std::string& line :
       {std::string(), std::string("Authorization: \r\n"), "Authorization: " + token + "\r\n",
        std::string("Authorization: Bearer\r\n"), "Authorization: Bearer " + token + "x\r\n",
        "Authorization: Bearer " + token.substr(1) + "\r\n",
        "Authorization: Bearer " + token + token + "\r\n", "Authorization: Digest " + token + "\r\n",
        std::string("Authorization: Basic !!!!\r\n"),
        // The token alone, without a colon before it.
        std::string("Authorization: Basic YWJjZGVmZ2hpai0wMTIzNDU2Nzg5\r\n"), "Cookie: " + token + "\r\n"})
    EXPECT_EQ(status(line), 401) << line;
  EXPECT_EQ(status("Authorization: Bearer " + token + "\r\nAuthorization: Bearer " + token + "\r\n"), 400);
  // Strangers learn nothing about which methods there are, nor a page elsewhere about the token.
  EXPECT_EQ(judge_head("PUT / HTTP/1.1\r\nHost: localhost\r\n\r\n", {"localhost"}, token).status, 401);
  EXPECT_EQ(status("Origin: http://evil.example\r\nAuthorization: Bearer " + token + "\r\n"), 403);
}

TEST(RequestHead, OnlyTheWholeSecretIsTheSame) {
  EXPECT_TRUE(is_same_secret("secret", "secret"));
  for (const char* other : {"", "secre", "secrets", "Secret", "secreT", "secretsecret", "terces"})
    EXPECT_FALSE(is_same_secret(other, "secret")) << other;
  EXPECT_FALSE(is_same_secret("", "")) << "no secret lets nobody in";
}

TEST(RequestHead, EveryPrefixAndEveryChangedByteIsJudgedWithoutHarm) {
  const std::string head = "GET /v1/status HTTP/1.1\r\nHost: [::1]:80\r\nOrigin: http://localhost\r\n\r\n";
  for (std::size_t i = 0; i < head.size(); ++i) {
    status_of(head.substr(0, i));
    for (const char byte : {'\0', '\r', '\n', ' ', ':', ']', '\xFF'}) {
      std::string changed = head;
      changed[i] = byte;
      const int status = status_of(changed);
      EXPECT_TRUE(status == 0 || (status >= 400 && status < 600));
    }
  }
}

}  // namespace
}  // namespace herr
