//! The secret of one start, without which nothing of the folder is given.

use std::fmt::Write as _;
use std::hint::black_box;
use std::io;

/// 256 random bits. The page has them in the fragment of its address, which no request carries.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// A new one.
    ///
    /// # Errors
    /// That of a system without random numbers.
    pub(crate) fn random() -> io::Result<Token> {
        let mut bytes = [0; 32];
        getrandom::fill(&mut bytes).map_err(|e| io::Error::other(e.to_string()))?;
        Ok(Token(hex(&bytes)))
    }

    /// Its 64 hexadecimal digits.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether a word is it; the time that the answer takes does not tell how much of it is right.
    pub(crate) fn is(&self, word: &[u8]) -> bool {
        let own = self.0.as_bytes();
        if word.len() != own.len() {
            return false;
        }
        let differing = own.iter().zip(word).fold(0u8, |sum, (a, b)| black_box(sum | (a ^ b)));
        black_box(differing) == 0
    }
}

/// A word that is used once: for the styles of one answer.
pub(crate) fn nonce() -> io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|e| io::Error::other(e.to_string()))?;
    Ok(hex(&bytes))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_whole_token_is_it() {
        let token = Token::random().unwrap();
        let text = token.as_str().to_owned();
        assert!(text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit()));
        assert!(token.is(text.as_bytes()));
        let wrong = text.replace(text.chars().last().unwrap(), "g");
        for word in ["", &text[..63], &format!("{text}0"), &text.to_uppercase().replace('A', "a"), &wrong] {
            assert!(word == text || !token.is(word.as_bytes()), "{word}");
        }
        assert_ne!(Token::random().unwrap().as_str(), text);
    }
}
