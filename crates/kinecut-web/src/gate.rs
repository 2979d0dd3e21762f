//! The checks that every request passes before it is routed. Loopback is no access control: any page in a browser and any user of
//! the machine can reach it.

use axum::http::request::Parts;
use axum::http::{HeaderMap, Method, StatusCode, header};

use crate::refusal::Refusal;
use crate::token::Token;

/// Names under which the server may be called, and the secret that it wants.
pub(crate) struct Gate {
    hosts: [String; 3],
    token: Token,
}

/// A request that has passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Passed {
    /// One for the page and its assets, which hold no secret.
    Page,
    /// One that knows the token.
    Api,
}

impl Gate {
    pub(crate) fn new(port: u16, token: Token) -> Gate {
        Gate { hosts: ["127.0.0.1", "localhost", "[::1]"].map(|host| format!("{host}:{port}")), token }
    }

    /// The checks of a request's head.
    ///
    /// # Errors
    /// The refusal of a foreign or doubtful request.
    pub(crate) fn check(&self, head: &Parts) -> Result<Passed, Refusal> {
        let host = self.host(head)?;
        self.origin(head, host)?;
        let path = head.uri.path();
        if is_page(path) {
            return Ok(Passed::Page);
        }
        let token = only(&head.headers, header::AUTHORIZATION.as_str())
            .and_then(|value| value.strip_prefix(b"Bearer "))
            .is_some_and(|word| self.token.is(word));
        if !token {
            return Err(Refusal::new(StatusCode::UNAUTHORIZED, "token", "the token is missing or wrong")
                .help("open the address that `kinecut open` has printed"));
        }
        if reads_only(&head.method) {
            return Ok(Passed::Api);
        }
        match only(&head.headers, header::CONTENT_TYPE.as_str()) {
            Some(kind) if is_json(kind) => Ok(Passed::Api),
            _ => Err(Refusal::new(
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                "type",
                "only Content-Type: application/json is read",
            )),
        }
    }

    /// The name by which the server was called: one, and one of ours. A name that was bound to this machine by others is not.
    fn host<'a>(&self, head: &'a Parts) -> Result<&'a [u8], Refusal> {
        let host = only(&head.headers, header::HOST.as_str())
            .filter(|host| self.hosts.iter().any(|own| own.as_bytes() == *host));
        // A target that names a host of its own would be another one.
        match host.filter(|_| head.uri.authority().is_none()) {
            Some(host) => Ok(host),
            None => Err(Refusal::new(
                StatusCode::FORBIDDEN,
                "host",
                "the Host of this request is not this server",
            )
            .help("open the address that `kinecut open` has printed")),
        }
    }

    /// The page that sends the request: ours, or for reading none that the browser tells of.
    fn origin(&self, head: &Parts, host: &[u8]) -> Result<(), Refusal> {
        let own = |origin: &[u8]| origin.strip_prefix(b"http://").is_some_and(|rest| rest == host);
        let fine = match head.headers.contains_key(header::ORIGIN) {
            true => only(&head.headers, header::ORIGIN.as_str()).is_some_and(own),
            false => reads_only(&head.method),
        };
        if !fine {
            let message = "the Origin of this request is another page, or is missing";
            return Err(Refusal::new(StatusCode::FORBIDDEN, "origin", message));
        }
        let site = match head.headers.contains_key("sec-fetch-site") {
            true => only(&head.headers, "sec-fetch-site"),
            false => Some(&b"none"[..]),
        };
        if site.is_none_or(|site| site != b"same-origin" && site != b"none") {
            let message = "the browser says that another site sends this request";
            return Err(Refusal::new(StatusCode::FORBIDDEN, "site", message));
        }
        Ok(())
    }
}

/// Whether a path is one of the page and its assets.
fn is_page(path: &str) -> bool {
    matches!(path, "/" | "/index.html" | "/favicon.ico") || path.starts_with("/assets/")
}

/// Whether a method changes nothing.
fn reads_only(method: &Method) -> bool {
    matches!(*method, Method::GET | Method::HEAD)
}

/// The value of a header that is there once.
fn only<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a [u8]> {
    let mut values = headers.get_all(name).iter();
    match (values.next(), values.next()) {
        (Some(value), None) => Some(value.as_bytes()),
        _ => None,
    }
}

fn is_json(kind: &[u8]) -> bool {
    let kind = String::from_utf8_lossy(kind).to_ascii_lowercase();
    let (essence, parameter) = kind.split_once(';').unwrap_or((&kind, ""));
    essence.trim() == "application/json" && matches!(parameter.trim(), "" | "charset=utf-8")
}

#[cfg(test)]
mod tests {
    use axum::http::Request;

    use super::*;

    fn gate() -> (Gate, String) {
        let token = Token::random().unwrap();
        let bearer = format!("Bearer {}", token.as_str());
        (Gate::new(4711, token), bearer)
    }

    fn head(method: &str, path: &str, headers: &[(&str, &str)]) -> Parts {
        let request =
            headers.iter().fold(Request::builder().method(method).uri(path), |r, (k, v)| r.header(*k, *v));
        request.body(()).unwrap().into_parts().0
    }

    #[test]
    fn a_request_passes_only_with_all_that_it_needs() {
        let (gate, bearer) = gate();
        let all = [
            ("host", "localhost:4711"),
            ("origin", "http://localhost:4711"),
            ("authorization", bearer.as_str()),
            ("content-type", "application/json; charset=UTF-8"),
            ("sec-fetch-site", "same-origin"),
        ];
        assert_eq!(gate.check(&head("POST", "/api/plan", &all)), Ok(Passed::Api));
        // Without any of them but the one that not every browser sends it does not.
        for i in 0..4 {
            let less: Vec<_> = all.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, h)| *h).collect();
            assert!(gate.check(&head("POST", "/api/plan", &less)).is_err(), "{}", all[i].0);
        }
        assert!(gate.check(&head("POST", "/api/plan", &all[..4])).is_ok());
        // Nor with one of them twice.
        for twice in all {
            let more: Vec<_> = all.into_iter().chain([twice]).collect();
            assert!(gate.check(&head("POST", "/api/plan", &more)).is_err(), "{}", twice.0);
        }
        for (name, value) in [
            ("host", "localhost:4712"),
            ("host", "LOCALHOST:4711"),
            ("host", "evil.example:4711"),
            ("host", "localhost"),
            ("origin", "http://127.0.0.1:4711"),
            ("origin", "https://localhost:4711"),
            ("origin", "null"),
            ("authorization", "Bearer 00"),
            ("content-type", "text/plain"),
            ("content-type", "application/json; boundary=x"),
            ("sec-fetch-site", "cross-site"),
            ("sec-fetch-site", "same-site"),
        ] {
            let other: Vec<_> = all.iter().map(|h| if h.0 == name { (name, value) } else { *h }).collect();
            assert!(gate.check(&head("POST", "/api/plan", &other)).is_err(), "{name}: {value}");
        }
    }

    #[test]
    fn the_page_needs_no_token_and_all_else_does() {
        let (gate, _) = gate();
        let host = [("host", "127.0.0.1:4711")];
        for path in ["/", "/index.html", "/assets/app.js", "/assets/../api/project"] {
            assert_eq!(gate.check(&head("GET", path, &host)), Ok(Passed::Page), "{path}");
        }
        for path in ["/api/project", "/%61pi/project", "//api/project", "/assets", "/x"] {
            assert!(gate.check(&head("GET", path, &host)).is_err(), "{path}");
        }
        assert!(gate.check(&head("GET", "http://evil.example/", &host)).is_err());
        // A page of another name sends no Origin when it reads.
        for name in ["evil.example:4711", "127.0.0.1", "LOCALHOST:4711", "127.0.0.1:4712", ""] {
            assert!(gate.check(&head("GET", "/", &[("host", name)])).is_err(), "{name}");
        }
    }
}
