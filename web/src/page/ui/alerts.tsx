import type { Message, State } from '../state';

/** What went wrong and other news, on top of the picture. */
export function Alerts({ state }: { state: State }) {
  return (
    <>
      {state.messages.value.map((message) =>
        message.kind === 'notice' ? (
          <div key={message.id} class="notice" role="status" data-test="notice">
            <p>{message.detail}</p>
          </div>
        ) : (
          <Alert key={message.id} message={message} dismiss={() => state.dismiss(message.id)} />
        ),
      )}
    </>
  );
}

function Alert({ message, dismiss }: { message: Message; dismiss: () => void }) {
  return (
    <div class="alert" role="alert" data-test="alert">
      <strong>{message.title}</strong>
      <p>{message.detail}</p>
      <button type="button" class="quiet" onClick={dismiss}>
        Dismiss
      </button>
    </div>
  );
}
